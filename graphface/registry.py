"""Where operators are found: installed packs, and plug-in files named on the command line.

A pack maps operator families to modules, so that a graph which uses one method imports one module: a matting
Laplacian is not loaded to turn a photo grey. An installed distribution offers its pack through the
`graphface.nodes` entry-point group:

    pack = Pack("mine", operators={"blur": "mine.blur"}, types={"Blurred": "mine.blur:Blurred"})
"""

from __future__ import annotations

import importlib
import importlib.util
import os.path
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from graphface.errors import PluginError, UnknownOperator, UnknownType
from graphface.node import Operator, operator_of
from graphface.values.port_types import ANY, Atom, ListOf, PortType, port_type

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
        graphs: the package whose folder holds shipped graph files.
        assets: "module:attribute" of tuples of `graphface.Asset`, the files that its operators fetch, separated by
            spaces.
        schemas: kind of file ("scene") to "module:attribute" of a pydantic model, or of a function that returns a JSON
            Schema, for `graphface schema --kind`.
    """

    name: str
    operators: Mapping[str, str]
    types: Mapping[str, str] = field(default_factory=dict)
    graphs: str = ""
    assets: str = ""
    schemas: Mapping[str, str] = field(default_factory=dict)


class Registry:
    """The operators and types that graph files may name."""

    def __init__(self, packs: list[Pack] | None = None) -> None:
        self._packs = packs if packs is not None else []
        self._added: dict[str, Operator] = {}
        self._loaded: dict[str, dict[str, Operator]] = {}

    def add(self, function: object) -> None:
        """Register one `@node` function (a notebook's own, say); a later one of the same name replaces it."""
        operator = operator_of(function)
        if operator is None:
            raise TypeError(f"{function!r} is not declared with @node")
        self._added[operator.name] = operator

    def add_file(self, path: Path) -> list[str]:
        """Execute a plug-in file and register every operator it declares; their names.

        Raises:
            PluginError: the file is missing, fails to import, or declares no operator.
        """
        functions = [f for f in vars(_import_file(path)).values() if operator_of(f) is not None]
        if not functions:
            raise PluginError(f"{path}: declares no operator; put @node on a function", path=path)
        for function in functions:
            self.add(function)
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

    def schemas(self) -> dict[str, Any]:
        """Kinds of files to what describes them: pydantic models, and functions that return a JSON Schema."""
        return {kind: _attribute(where) for pack in self._packs for kind, where in pack.schemas.items()}

    def type_classes(self) -> list[Any]:
        """What the packs' type names stand for."""
        return [_attribute(where) for pack in self._packs for where in pack.types.values()]

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
