"""What the file of a module says: its syntax, the modules it imports, the data files it names, what its names mean."""

from __future__ import annotations

import ast
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cached_property
from glob import escape
from importlib.machinery import SourceFileLoader
from importlib.util import cache_from_source
from pathlib import Path
from types import CodeType
from typing import Any

from graphface.fingerprint.modules import absolute, distribution, imported
from graphface.fingerprint.syntax import for_type_checkers, ignored, syntax
from graphface.values.digest import new_hash

Binding = tuple[str, Any]
"""("def", whether it is decorated), ("import", (module, name in it or None)) or ("literal", value)."""

_RACY = 2.0
"""Seconds within which a file may be written twice with one time stamp."""

_DEFINES = (ast.Import, ast.ImportFrom, ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Assign, ast.AnnAssign)
_CODE = (".py", ".pyc")
_WORDS = re.compile(r"""["'][\w./-]+["'](?:\s*[/,]\s*["'][\w./-]+["'])*""")
"""Quoted words that may be steps of one path: `/ "data" / "lut.npz"`, `("data", "lut.npz")`."""


class Source:
    """The file of a module.

    Attributes:
        digest: 16 bytes of its syntax; of its bytes where it is not Python.
        imports: the modules it imports, at the top or inside functions; not those that only type checkers import.
        files: the data files it names; looked for beside it and in the folders of its package above.
        has_effects: whether importing it does more than define names.
        bindings: what its names and those of its classes ("Table.read") mean; None where no single statement says it.

    Raises:
        OSError: it cannot be read.
    """

    def __init__(self, module: str, path: Path) -> None:
        self.path = path
        self._module = module
        text = path.read_bytes()
        self._text = text if path.suffix == ".py" else b""
        self._package = module if path.stem == "__init__" else module.rpartition(".")[0]
        self.bindings: dict[str, Binding | None] = {}
        tree, content = ast.Module([], []), text
        with suppress(SyntaxError, ValueError):
            tree = ast.parse(self._text)
            content = syntax(tree) if path.suffix == ".py" else text
        state = new_hash()
        state.update(content)
        self.digest: bytes = state.digest()
        top = distribution(module)
        statements = dict.fromkeys(self._read(tree.body, ""))
        self.imports: tuple[str, ...] = tuple(
            dict.fromkeys(name for read in statements for name in imported(*read, top))
        )
        self.has_effects: bool = not all(isinstance(node, _DEFINES) or ignored(node, tree) for node in tree.body)
        depth = self._package.count(".") - top.count(".") + 1
        self.files: tuple[Path, ...] = tuple(dict.fromkeys(self._named_files(path.parents[:depth])))

    @cached_property
    def codes(self) -> dict[str, list[CodeType]]:
        """The code of every function and class in the file, by qualified name; empty where it is not Python."""
        found: dict[str, list[CodeType]] = {}
        try:
            pending = [self._compiled() or compile(self._text, str(self.path), "exec", dont_inherit=True)]
        except (SyntaxError, ValueError):
            return found
        while pending:
            inner = [constant for constant in pending.pop().co_consts if isinstance(constant, CodeType)]
            pending += inner
            for code in inner:
                found.setdefault(code.co_qualname, []).append(code)
        return found

    def _compiled(self) -> CodeType | None:
        """What Python compiled earlier; None where it is so young that a second edit could hide in its time stamp."""
        try:
            if os.stat(cache_from_source(self.path)).st_mtime < os.stat(self.path).st_mtime + _RACY:
                return None
            return SourceFileLoader(self._module, str(self.path)).get_code(self._module)
        except (OSError, ImportError, NotImplementedError):
            return None

    def _read(self, body: Iterable[ast.AST], scope: str | None) -> Iterator[tuple[str, tuple[str, ...]]]:
        """Module and names of the import statements in `body`; what it binds is recorded (scope: None in functions)."""
        for node in body:
            match node:
                case ast.Import() | ast.ImportFrom():
                    yield from self._import(node, scope)
                case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                    self._bind(scope, node.name, ("def", bool(node.decorator_list)))
                    inside = isinstance(node, ast.ClassDef) and scope is not None
                    yield from self._read(node.body, f"{scope}{node.name}." if inside else None)
                case ast.Assign(targets=targets, value=ast.expr() as value):
                    self._assign(scope, targets, value)
                case ast.AnnAssign(target=target, value=ast.expr() as value):
                    self._assign(scope, [target], value)
                case ast.AugAssign(target=target):
                    self._assign(scope, [target], None)
                case _:
                    never = "body" if for_type_checkers(node) else ""
                    for part in ("body", "orelse", "finalbody", "handlers", "cases"):
                        if part != never and (inner := getattr(node, part, None)):
                            yield from self._read(inner, scope)

    def _import(self, node: ast.Import | ast.ImportFrom, scope: str | None) -> Iterator[tuple[str, tuple[str, ...]]]:
        if isinstance(node, ast.Import):
            for alias in node.names:
                top = alias.name.partition(".")[0]
                self._bind(scope, alias.asname or top, ("import", (alias.name if alias.asname else top, None)))
                yield alias.name, ()
            return
        module = absolute("." * node.level + (node.module or ""), self._package)
        for alias in node.names:
            self._bind(scope, alias.asname or alias.name, ("import", (module, alias.name)))
        yield module, tuple(alias.name for alias in node.names)

    def _assign(self, scope: str | None, targets: list[ast.expr], value: ast.expr | None) -> None:
        if scope is None:
            return
        binding: Binding | None = None
        with suppress(ValueError, TypeError, SyntaxError, RecursionError):  # computed
            binding = ("literal", ast.literal_eval(value)) if value is not None else None
        for target in targets:
            for node in ast.walk(target):
                if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                    self._bind(scope, node.id, binding if node is target else None)

    def _bind(self, scope: str | None, name: str, binding: Binding | None) -> None:
        if scope is not None:
            label = scope + name
            known = self.bindings.setdefault(label, binding)
            if known is not binding and (known is None or binding is None or known[0] != "def" or binding[0] != "def"):
                self.bindings[label] = None  # bound twice; overloads and setters are functions of one name

    def _named_files(self, folders: Sequence[Path]) -> Iterator[Path]:
        """The files that quoted words name, with those beside them of another suffix: a card belongs to its weights.

        What the kernel shows as files, such as the memory that is free, is no part of the code.
        """
        for quoted in _WORDS.findall(self._text.decode("utf-8", "replace")):
            words = re.findall(r"[\w./-]+", quoted)
            for name in (*words, "/".join(words)):
                for file in (folder / name for folder in folders if _may_name(name)):
                    if file.suffix not in _CODE and file.is_file():
                        others = file.parent.glob(escape(file.stem) + ".*")
                        yield from sorted({file, *(other for other in others if other.suffix not in _CODE)})


def _may_name(name: str) -> bool:
    return ("." in name or "/" in name) and not name.startswith(("/proc/", "/sys/", "/dev/"))
