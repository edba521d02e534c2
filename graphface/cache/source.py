"""A module read from its file, for imports that stand inside a function.

Such a module may not be loaded yet. Importing it only to learn what it says would cost a warm run the very import that
the function postpones; walking it where it happens to be loaded, and reading its file where it is not, would give one
operator two fingerprints. So it always counts by its source, cut down to the statements that the imported names need,
and objects that the source does not account for (`drifted`) are walked on top: those replaced at run time, or loaded
before the file was edited.
"""

from __future__ import annotations

import ast
import sys
from dataclasses import dataclass
from functools import cached_property
from importlib.machinery import PathFinder
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

from graphface.cache.beside import named_files
from graphface.cache.bytecode import Import, read_code
from graphface.values.digest import Undigestible, exact, new_hash


@dataclass(frozen=True)
class Slice:
    """The statements of a module that one of its names needs.

    Attributes:
        digest: 16 bytes over their syntax: no comments, docstrings or layout.
        names: the module's own names that they bind.
        imports: import statements among or inside them.
        files: what they make of `__file__`.
    """

    digest: bytes
    names: tuple[str, ...]
    imports: tuple[Import, ...]
    files: tuple[Path, ...]


class Source:
    """One source file.

    Raises:
        OSError: it cannot be read.
        SyntaxError: it is not Python.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._text = path.read_bytes()
        body = _without_docstrings(ast.parse(self._text)).body
        self._statements = [_Statement(node) for node in body if not _for_type_checkers(node)]
        self._first_seen: dict[str, Any] = {}
        self._slices: dict[str | None, Slice] = {}

    def slice(self, name: str | None) -> Slice:
        """What `name` needs, transitively; the whole module for None."""
        if name not in self._slices:
            self._slices[name] = self._cut(name)
        return self._slices[name]

    def imported(self, name: str) -> tuple[Import, str] | None:
        """The import statement that binds `name` and the name it has there, if an import binds it."""
        return next((s.imported[name] for s in self._statements if name in s.imported), None)

    def first_seen(self, name: str, value: object) -> object:
        """The object that `name` stood for when first asked: a computed constant has no other reference."""
        return self._first_seen.setdefault(name, value)

    @cached_property
    def literals(self) -> dict[str, Any]:
        """Names assigned once, to a literal."""
        assigned = [s for s in self._statements if isinstance(s.node, ast.Assign | ast.AnnAssign) and s.node.value]
        values = {}
        for statement in assigned:
            for name in statement.binds:
                try:
                    values[name] = ast.literal_eval(statement.node.value)  # type: ignore[attr-defined]
                except (ValueError, TypeError):
                    continue
        counts = [name for s in self._statements for name in s.binds]
        return {name: value for name, value in values.items() if counts.count(name) == 1}

    def holds(self, code: CodeType, name: str | None = None) -> bool:
        """Whether the file has this code, under its own qualified name or, for a function it defines, as `name`."""
        defined = name if name in self._functions else code.co_qualname
        return read_code(code).digest in self._functions.get(defined or "", ())

    @cached_property
    def _functions(self) -> dict[str, set[bytes]]:
        """The content of every function in the file, by qualified name."""
        pending = [compile(self._text, str(self.path), "exec", dont_inherit=True)]
        found: dict[str, set[bytes]] = {}
        while pending:
            code = pending.pop()
            found.setdefault(code.co_qualname, set()).add(read_code(code).digest)
            pending.extend(constant for constant in code.co_consts if isinstance(constant, CodeType))
        return found

    def _cut(self, name: str | None) -> Slice:
        # A statement that binds nothing (a registration, a try around an import) may do anything: it always counts.
        seen = {s for s in self._statements if name is None or not s.binds}
        while True:
            wanted = {n for s in seen for n in s.uses} | {name}
            more = {s for s in self._statements if s.binds & wanted} - seen
            if not more:
                break
            seen |= more
        kept = [s for s in self._statements if s in seen]
        state = new_hash()
        for statement in kept:
            state.update(ast.dump(statement.node).encode("utf-8", "surrogatepass") + b"\n")
        names = sorted({n for s in kept for n in s.binds})
        imports = dict.fromkeys(i for s in kept for i in s.imports)
        files = {f for s in kept if "__file__" in s.uses for f in named_files(s.node, self.path)}
        return Slice(state.digest(), tuple(names), tuple(imports), tuple(sorted(files)))


class _Statement:
    """A top-level statement: the names it binds and uses, and the imports in it."""

    def __init__(self, node: ast.stmt) -> None:
        self.node = node
        self.imports: list[Import] = []
        self.imported: dict[str, tuple[Import, str]] = {}
        self.uses: set[str] = set()
        self.binds: set[str] = set()
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            self.binds.add(node.name)
        top = isinstance(node, ast.Import | ast.ImportFrom)
        for part in ast.walk(node):
            if isinstance(part, ast.Name):
                self.uses.add(part.id)
                if isinstance(part.ctx, ast.Store) and isinstance(node, ast.Assign | ast.AnnAssign | ast.AugAssign):
                    self.binds.add(part.id)
            elif isinstance(part, ast.ImportFrom):
                self._add(part, Import(part.module or "", part.level, tuple(a.name for a in part.names)), top)
            elif isinstance(part, ast.Import):
                for alias in part.names:
                    self._add(ast.Import([alias]), Import(alias.name, 0, None), top)

    def _add(self, node: ast.Import | ast.ImportFrom, statement: Import, top: bool) -> None:
        self.imports.append(statement)
        for alias in node.names if top else []:
            bound = alias.asname or alias.name.partition(".")[0]
            self.binds.add(bound)
            self.imported[bound] = (statement, alias.name)


def locate(module: str) -> Path | None:
    """The source file of a module, found without importing it or its parents; None where there is none."""
    loaded = sys.modules.get(module)
    if loaded is not None:
        origin = getattr(loaded, "__file__", None)
    else:
        parent, _, _ = module.rpartition(".")
        search = _search_path(parent) if parent else None
        spec = PathFinder.find_spec(module, search) if search or not parent else None
        origin = spec.origin if spec is not None else None
    return Path(origin) if origin is not None and origin.endswith(".py") else None


def drifted(source: Source, module: ModuleType, name: str) -> bool:
    """Whether what `module` holds under `name` is not what `source` says."""
    value = vars(module).get(name)
    imported = source.imported(name)
    if imported is not None:
        statement, original = imported
        holder = sys.modules.get(absolute(statement, module.__package__ or ""))
        known = holder is not None and statement.names is not None and original in vars(holder)
        return known and vars(holder)[original] is not value
    if name in source.literals:
        try:
            return exact(source.literals[name]) != exact(value)
        except Undigestible:
            return True
    if isinstance(value, FunctionType):
        return not source.holds(value.__code__, name) and not hasattr(value, "__wrapped__")
    if isinstance(value, type):
        methods = [m for m in vars(value).values() if isinstance(m, FunctionType)]
        written = [m for m in methods if m.__code__.co_filename != "<string>"]
        return value.__module__ != module.__name__ or not all(source.holds(m.__code__) for m in written)
    return source.first_seen(name, value) is not value


def absolute(statement: Import, package: str) -> str:
    """The full name of the module that an import statement in `package` names."""
    if statement.level == 0:
        return statement.module
    base = package.rsplit(".", statement.level - 1)[0] if statement.level > 1 else package
    return f"{base}.{statement.module}" if statement.module else base


def _search_path(package: str) -> list[str] | None:
    loaded = sys.modules.get(package)
    if loaded is not None:
        return list(getattr(loaded, "__path__", []))
    parent, _, _ = package.rpartition(".")
    above = _search_path(parent) if parent else None
    if parent and not above:
        return None
    spec = PathFinder.find_spec(package, above)
    return list(spec.submodule_search_locations or []) if spec is not None else None


def _for_type_checkers(node: ast.stmt) -> bool:
    return isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"


def _without_docstrings(tree: ast.Module) -> ast.Module:
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    for node in ast.walk(tree):
        if isinstance(node, documented) and ast.get_docstring(node, clean=False) is not None:
            node.body = node.body[1:]
    return tree
