"""Where operators are found: installed packs, and plug-in files named on the command line.

A pack maps operator families to modules, so that a graph which uses one method imports one module: a matting
Laplacian is not loaded to turn a photo grey. An installed distribution offers its pack through the
`graphface.nodes` entry-point group:

    pack = Pack("mine", operators={"blur": "mine.blur"}, types={"Blurred": "mine.blur:Blurred"})

How a type's values are read from and written to files is no affair of the type's (`graphface.values.files`): a pack
names it in `files`, a plug-in file in a constant `FILES = {Blurred: Files(...)}`.
"""

from __future__ import annotations

import importlib
import importlib.util
import os.path
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from graphface.errors import PluginError, UnknownOperator, UnknownType
from graphface.node import Operator, operator_of
from graphface.values.files import Files
from graphface.values.port_types import ANY, ArrayType, Atom, ListOf, PortType, port_type

if TYPE_CHECKING:
    from graphface.assets.asset import Asset

ENTRY_POINTS = "graphface.nodes"
_MAX_LISTS = 8
_BUILTIN_TYPES: dict[str, Any] = {"Any": object, "int": int, "float": float, "str": str, "bool": bool, "Path": Path}


@dataclass(frozen=True)
class Pack:
    """What a distribution of operators offers.

    Args:
        name: for messages.
        operators: operator family ("intrinsic" for `intrinsic.*`) to the modules that declare it, separated by spaces
            where a family is spread over several.
        types: name used in graph files to "module:attribute".
        files: name in `types`, which must also be that of the class, of the array type or of the attribute, to
            "module:attribute" of a `Files`.
        graphs: the package whose folder holds shipped graph files.
        assets: "module:attribute" of tuples of `graphface.assets.asset.Asset`, the files that its operators fetch,
            separated by spaces.
    """

    name: str
    operators: Mapping[str, str]
    types: Mapping[str, str] = field(default_factory=dict)
    files: Mapping[str, str] = field(default_factory=dict)
    graphs: str = ""
    assets: str = ""


class Registry:
    """The operators and types that graph files may name."""

    def __init__(self, packs: list[Pack] | None = None) -> None:
        self._packs = packs if packs is not None else []
        self._added: dict[str, Operator] = {}
        self._loaded: dict[str, dict[str, Operator]] = {}
        self._added_files: dict[Atom, Files] = {}
        self._files: dict[Atom, Files | None] = {}

    def add(self, function: object) -> None:
        """Register one `@node` function (a notebook's own, say); a later one of the same name replaces it."""
        operator = operator_of(function)
        if operator is None:
            raise TypeError(f"{function!r} is not declared with @node")
        self._added[operator.name] = operator

    def add_files(self, kind: Any, files: Files) -> None:
        """Say how values of a class, or of an array type, are read from and written to files."""
        self._added_files |= dict.fromkeys(port_type(kind).alternatives, files)
        self._files.clear()

    def add_file(self, path: Path) -> list[str]:
        """Execute a plug-in file and register every operator and the `FILES` it declares; the operators' names.

        Raises:
            PluginError: the file is missing, fails to import, or declares no operator.
        """
        module = _import_file(path)
        functions = [f for f in vars(module).values() if operator_of(f) is not None]
        if not functions:
            raise PluginError(f"{path}: declares no operator; put @node on a function", path=path)
        for function in functions:
            self.add(function)
        for kind, files in getattr(module, "FILES", {}).items():
            self.add_files(kind, files)
        return sorted({operator.name for f in functions if (operator := operator_of(f)) is not None})

    def operator(self, name: str) -> Operator:
        """The operator called `name`.

        Raises:
            UnknownOperator: with the nearest names.
        """
        found = self._added.get(name) or self._family(name.rpartition(".")[0]).get(name)
        if found is None:
            raise UnknownOperator(name, self.names())
        return found

    def names(self) -> list[str]:
        """Every operator name, sorted. Imports every pack."""
        families = {family for pack in self._packs for family in pack.operators}
        installed = {name for family in families for name in self._family(family)}
        return sorted(installed | set(self._added))

    def alternatives(self, operator: Operator) -> Iterator[Operator]:
        """The other operators of the family whose ports agree: what `replace` may put in its place."""
        siblings = {**self._family(operator.family), **self._added}
        for name, other in sorted(siblings.items()):
            if name != operator.name and other.family == operator.family and interchangeable(operator, other):
                yield other

    def type(self, text: str) -> PortType:
        """The port type that a graph file writes as `text`: "Image", "Mask | None", "list[Image]".

        Raises:
            UnknownType: with the nearest names.
        """
        if text.count("[") > _MAX_LISTS:
            raise UnknownType(text, self.type_names())
        parts = _alternatives(text)
        optional = "None" in parts
        atoms: list[Atom] = []
        for part in parts:
            if part == "None":
                continue
            if part.startswith("list[") and part.endswith("]"):
                atoms.append(ListOf(self.type(part[5:-1])))
            else:
                atoms.extend(self._named_type(part).alternatives)
        if not atoms:
            raise UnknownType(text, self.type_names())
        return PortType(tuple(atoms), optional or atoms == [object])

    def type_names(self) -> list[str]:
        return sorted({"Array", *_BUILTIN_TYPES, *(name for pack in self._packs for name in pack.types)})

    def extended(self) -> Registry:
        """A registry with everything of this one, to which more can be added without changing this one."""
        other = Registry(self._packs)
        other._added = dict(self._added)
        other._loaded = self._loaded
        other._added_files = dict(self._added_files)
        return other

    def graph_packages(self) -> list[str]:
        """Packages whose folders hold shipped graph files."""
        return [pack.graphs for pack in self._packs if pack.graphs]

    def assets(self) -> list[Asset]:
        """The files that operators of the packs fetch when first needed."""
        found: list[Asset] = []
        for pack in self._packs:
            for where in pack.assets.split():
                found += _attribute(where)
        return found

    def files(self, kind: Atom | PortType) -> Files | None:
        """How values of a type are read from and written to files; of a port, those of the first alternative with any.

        What has no files of its own is written as the nearest base class is, or the parent of an array type, and is not
        read: that would give a value of the base class.
        """
        if isinstance(kind, PortType):
            return next((files for atom in kind.alternatives if (files := self.files(atom)) is not None), None)
        if kind not in self._files:
            own = ((base, self._own_files(base)) for base in _lineage(kind))
            base, found = next(((base, files) for base, files in own if files is not None), (kind, None))
            self._files[kind] = found if found is None or base is kind else replace(found, read=None)
        return self._files[kind]

    def all_files(self) -> list[Files]:
        """The files of every type that has any."""
        named = (_attribute(where) for pack in self._packs for where in pack.files.values())
        return [*self._added_files.values(), *named]

    def _own_files(self, atom: Atom) -> Files | None:
        """The files of just this type. Only a type of the same name is imported to see whether it is this one."""
        if atom in self._added_files:
            return self._added_files[atom]
        own_name = atom.name if isinstance(atom, ArrayType) else getattr(atom, "__name__", "")
        for pack in self._packs:
            for name, where in pack.files.items():
                kind = pack.types.get(name, "")
                if own_name in (name, kind.partition(":")[2]) and atom in port_type(_attribute(kind)).alternatives:
                    return _attribute(where)  # type: ignore[no-any-return]
        return None

    def _named_type(self, name: str) -> PortType:
        if name == "Any":
            return ANY
        if name == "Array":
            import numpy as np

            return port_type(np.ndarray)
        if name in _BUILTIN_TYPES:
            return port_type(_BUILTIN_TYPES[name])
        for pack in self._packs:
            if name in pack.types:
                return port_type(_attribute(pack.types[name]))
        raise UnknownType(name, self.type_names())

    def _family(self, family: str) -> dict[str, Operator]:
        """The operators of one family that packs declare, importing only the modules of that family."""
        if family not in self._loaded:
            modules = [m for pack in self._packs for m in pack.operators.get(family, "").split()]
            declared = (operator_of(f) for m in modules for f in vars(importlib.import_module(m)).values())
            self._loaded[family] = {op.name: op for op in declared if op is not None and op.family == family}
        return self._loaded[family]


def _lineage(atom: Atom) -> Iterator[Atom]:
    """A type and what it is a kind of, nearest first."""
    if isinstance(atom, type):
        yield from atom.__mro__
        return
    yield atom
    while isinstance(atom, ArrayType) and atom.parent is not None:
        atom = atom.parent
        yield atom


def _alternatives(text: str) -> list[str]:
    """ "list[A | None] | B" in parts: what stands between the bars outside brackets."""
    parts, depth = [""], 0
    for character in text:
        depth += (character == "[") - (character == "]")
        if character == "|" and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]


def interchangeable(one: Operator, other: Operator) -> bool:
    """Whether `other` can take the place of `one` in any graph: it wants no more and gives no less."""
    shared_inputs = all(
        name in one.inputs and port.type.accepts(one.inputs[name].type)
        for name, port in other.inputs.items()
        if port.required or name in one.inputs
    )
    offers = all(name in other.outputs and t.accepts(other.outputs[name]) for name, t in one.outputs.items())
    return shared_inputs and offers and one.output.accepts(other.output)


@cache
def default_registry() -> Registry:
    """The registry of everything installed."""
    from importlib.metadata import entry_points

    return Registry([point.load() for point in entry_points(group=ENTRY_POINTS)])


def _attribute(where: str) -> Any:
    """What "module:attribute" names."""
    module, _, name = where.partition(":")
    return getattr(importlib.import_module(module), name)


def _import_file(path: Path) -> ModuleType:
    name = f"graphface_plugin_{path.stem}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None or not os.path.isfile(path):
        raise PluginError(f"{path}: no such plug-in file", path=path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[name]
        raise PluginError(f"{path}: {type(error).__name__}: {error}", path=path) from error
    return module
