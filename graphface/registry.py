"""Where operators and types are found by their names: those of installed packs, and those added on top of them."""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from graphface.errors import DeclarationError, PluginError, UnknownOperator, UnknownType
from graphface.fallback import warn
from graphface.node import Operator, operator_of
from graphface.packs import (
    Pack,
    files_in,
    import_failure,
    import_file,
    installed_packs,
    operators_in,
    pictures_in,
    types_in,
)
from graphface.type_table import TypeTable
from graphface.values.files import Files
from graphface.values.port_types import ANY, Atom, ListOf, PortType, port_type

if TYPE_CHECKING:
    from graphface.assets.asset import Asset
    from graphface.values.picture import Draw

_MAX_LISTS = 8
_BUILTIN_TYPES: dict[str, Any] = {"Any": object, "int": int, "float": float, "str": str, "bool": bool, "Path": Path}


class Registry:
    """The operators and types that graph files may name."""

    def __init__(self, packs: list[Pack] | None = None) -> None:
        self._packs = packs if packs is not None else []
        self._added: dict[str, Operator] = {}
        self._added_types: dict[str, Any] = {}
        self._loaded: dict[str, dict[str, Operator]] = {}
        self._broken: dict[str, str] = {}
        self._files: TypeTable[Files] = TypeTable(self._packs, lambda pack: pack.files, self._attribute)
        self._pictures: TypeTable[Draw] = TypeTable(self._packs, lambda pack: pack.pictures, self._attribute)

    def add(self, function: object) -> None:
        """Register one `@node` function (a notebook's own, say); a later one of the same name replaces it."""
        operator = operator_of(function)
        if operator is None:
            raise TypeError(f"{function!r} is not declared with @node")
        self._added[operator.name] = operator

    def add_files(self, kind: Any, files: Files) -> None:
        """Say how values of a class, or of an array type, are read from and written to files."""
        self._files.add(kind, files)

    def add_picture(self, kind: Any, draw: Draw) -> None:
        """Say how values of a class, or of an array type, are drawn."""
        self._pictures.add(kind, draw)

    def add_file(self, path: Path) -> list[str]:
        """Execute a plug-in file and register its operators, types, `FILES` and `PICTURES`; the operators' names.

        Raises:
            PluginError: the file is missing, fails to import, or declares no operator.
        """
        module = import_file(path)
        operators = operators_in(module)
        if not operators:
            raise PluginError(f"{path}: declares no operator; put @node on a function", path=path)
        self._added |= operators
        self._added_types |= types_in(module)
        for kind, files in files_in(module).items():
            self.add_files(kind, files)
        for kind, draw in pictures_in(module).items():
            self.add_picture(kind, draw)
        return sorted(operators)

    def operator(self, name: str) -> Operator:
        """The operator called `name`, or that was called so before: its own name then is another.

        Raises:
            UnknownOperator: with the nearest names.
        """
        found = self._named(name) or self._formerly_named(name)
        if found is None:
            raise UnknownOperator(name, self.names(), self._why_unknown(name.rpartition(".")[0]))
        return found

    def operators(self) -> list[Operator]:
        """Every operator, by name. Those that are declared wrongly are left out, with a warning."""
        found = []
        for name in self.names():
            operator = self.operator(name)
            try:
                operator.check()
            except DeclarationError as error:
                warn(str(error))
            else:
                found.append(operator)
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
            if name != operator.name and other.family == operator.family and _may_replace(operator, other):
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
        packed = (name for pack in self._packs for name in pack.types)
        return sorted({"Array", *_BUILTIN_TYPES, *self._added_types, *packed})

    def extended(self) -> Registry:
        """A registry with everything of this one, to which more can be added without changing this one."""
        other = Registry(self._packs)
        other._added, other._added_types = dict(self._added), dict(self._added_types)
        other._files.add_all(self._files)
        other._pictures.add_all(self._pictures)
        other._loaded, other._broken = self._loaded, self._broken
        return other

    def graph_folders(self) -> list[Path]:
        """Folders of shipped graph files."""
        folders = []
        for package in (pack.graphs for pack in self._packs if pack.graphs):
            try:
                spec = importlib.util.find_spec(package)
            except ImportError as error:
                warn(f"the graphs of {package!r} are left out: {import_failure(error)}")
                continue
            if spec is not None and spec.submodule_search_locations:
                folders.append(Path(spec.submodule_search_locations[0]))
        return folders

    def assets(self) -> list[Asset]:
        """The files that operators of the packs fetch when first needed."""
        named = [self._attribute(where) for pack in self._packs for where in pack.assets.split()]
        return [asset for assets in named if assets is not None for asset in assets]

    def files(self, kind: Atom | PortType) -> Files | None:
        """How values of a type are read from and written to files; of a port, those of the first alternative with any.

        What has no files of its own is written as the nearest base class is, or the parent of an array type, and is not
        read: that would give a value of the base class.
        """
        if isinstance(kind, PortType):
            return next((files for atom in kind.alternatives if (files := self.files(atom)) is not None), None)
        found = self._files.nearest(kind)
        return found and (found[1] if found[0] is kind else replace(found[1], read=None))

    def all_files(self) -> list[Files]:
        """The files of every type that has any."""
        return list(self._files.all())

    def draw(self, kind: Atom) -> Draw | None:
        """How values of a type are drawn, as its nearest base class or parent says; None where nobody says."""
        found = self._pictures.nearest(kind)
        return found and found[1]

    def schemas(self) -> dict[str, Any]:
        """Kinds of files to what describes them: pydantic models, and functions that return a JSON Schema."""
        named = {kind: self._attribute(where) for pack in self._packs for kind, where in pack.schemas.items()}
        return {kind: found for kind, found in named.items() if found is not None}

    def _named_type(self, name: str) -> PortType:
        if name == "Any":
            return ANY
        if name == "Array":
            import numpy as np

            return port_type(np.ndarray)
        if name in _BUILTIN_TYPES:
            return port_type(_BUILTIN_TYPES[name])
        if name in self._added_types:
            return port_type(self._added_types[name])
        for pack in self._packs:
            if name in pack.types and (found := self._attribute(pack.types[name])) is not None:
                return port_type(found)
        raise UnknownType(name, self.type_names())

    def _named(self, name: str) -> Operator | None:
        return self._added.get(name) or self._family(name.rpartition(".")[0]).get(name)

    def _formerly_named(self, name: str) -> Operator | None:
        """The operator that had this name before, importing its family and that of the name."""
        at_hand = [*self._added.values(), *self._family(name.rpartition(".")[0]).values()]
        found = next((operator for operator in at_hand if name in operator.formerly), None)
        moved = (pack.formerly[name] for pack in self._packs if name in pack.formerly)
        return found or next((operator for new in moved if (operator := self._named(new)) is not None), None)

    def _family(self, family: str) -> dict[str, Operator]:
        """The operators of one family that packs declare, importing only the modules of that family."""
        if family not in self._loaded:
            modules = [m for pack in self._packs for m in pack.operators.get(family, "").split()]
            loaded = [module for name in modules if (module := self._module(name)) is not None]
            declared = {name: operator for module in loaded for name, operator in operators_in(module).items()}
            self._loaded[family] = {name: operator for name, operator in declared.items() if operator.family == family}
        return self._loaded[family]

    def _module(self, name: str) -> ModuleType | None:
        """A pack's module; None, with a warning when it is first asked for, where it cannot be imported."""
        if name in self._broken:
            return None
        try:
            return importlib.import_module(name)
        except (Exception, SystemExit) as error:
            self._broken[name] = import_failure(error)
            warn(f"module {name!r} of an installed pack is left out: {self._broken[name]}")
            return None

    def _attribute(self, where: str) -> Any:
        """What a pack's "module:attribute" names; None, with a warning, where there is no such thing."""
        name, _, attribute = where.partition(":")
        module = self._module(name)
        if module is not None and not hasattr(module, attribute):
            warn(f"{where!r} of an installed pack is left out: the module has no such name")
        return getattr(module, attribute, None)

    def _why_unknown(self, family: str) -> str:
        """What is known about an operator's absence from its family."""
        modules = [m for pack in self._packs for m in pack.operators.get(family, "").split()]
        broken = [f"module {name!r} cannot be used: {self._broken[name]}" for name in modules if name in self._broken]
        if broken or modules or any(operator.family == family for operator in self._added.values()) or not family:
            return "; ".join(broken)
        return (
            f"no installed pack has operators of family {family!r}; "
            "name its file with --plugin FILE or install its pack"
        )


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


def _may_replace(one: Operator, other: Operator) -> bool:
    """As `interchangeable`; an operator that is declared wrongly replaces none."""
    try:
        return interchangeable(one, other)
    except DeclarationError:
        return False


@cache
def default_registry() -> Registry:
    """The registry of everything installed; a pack that cannot be used is left out, with a warning."""
    return Registry(installed_packs())
