"""Packs: the operators and types that installed distributions and plug-in files offer.

An installed distribution offers its operators through the `graphface.nodes` entry-point group, whose entries name a
`Pack` or a plain module. A pack maps operator families to modules, so that a graph which uses one method imports one
module: a matting Laplacian is not loaded to turn a photo grey. A module is imported at once, and gives every operator
and type in it. One that cannot be used is reported in a sentence and left out: what somebody else installed must not
keep a graph from running.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import CodeType, ModuleType
from typing import TYPE_CHECKING, Any, TypeVar

from graphface.code_line import line_of_import
from graphface.errors import PluginError
from graphface.fallback import warn
from graphface.node import Operator, operator_of
from graphface.values.files import Files
from graphface.values.port_types import array_of

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

    from graphface.values.picture import Draw

T = TypeVar("T")
ENTRY_POINTS = "graphface.nodes"


@dataclass(frozen=True)
class Pack:
    """What a distribution of operators offers.

    Args:
        name: for messages.
        operators: operator family ("intrinsic" for `intrinsic.*`) to the modules that declare it, separated by spaces
            where a family is spread over several.
        types: name used in graph files to "module:attribute".
        files: name in `types` to "module:attribute" of a `graphface.Files`, or of a table from types to such. The name
            in `types`, or the attribute there, must be that of the class or array type.
        pictures: name in `types` to "module:attribute" of a function that draws it (`graphface.values.picture`),
            or of a table from types to such.
        graphs: the package whose folder holds shipped graph files.
        assets: "module:attribute" of tuples of `graphface.Asset`, the files that its operators fetch, separated by
            spaces.
        formerly: old operator name to the present one, where the operator has moved to another family; within a family
            `formerly` of `@node` is enough.
        schemas: kind of file ("scene") to "module:attribute" of a pydantic model, or of a function that returns a JSON
            Schema, for `graphface schema --kind`.
    """

    name: str
    operators: Mapping[str, str]
    types: Mapping[str, str] = field(default_factory=dict)
    files: Mapping[str, str] = field(default_factory=dict)
    pictures: Mapping[str, str] = field(default_factory=dict)
    graphs: str = ""
    assets: str = ""
    formerly: Mapping[str, str] = field(default_factory=dict)
    schemas: Mapping[str, str] = field(default_factory=dict)


def installed_packs() -> list[Pack]:
    """The packs of every distribution that is installed, without those that cannot be used; see `load_entry_point`."""
    from importlib.metadata import entry_points

    loaded = [load_entry_point(point, _as_pack) for point in entry_points(group=ENTRY_POINTS)]
    return [pack for pack in loaded if pack is not None]


def load_entry_point(point: EntryPoint, read: Callable[[Any], T]) -> T | None:
    """What an entry point names, read; None, with a warning that names distribution, entry point and reason, where it
    cannot be imported or `read` does not take it.
    """
    try:
        return read(point.load())
    except (Exception, SystemExit) as error:
        owner = f"{point.dist.name} {point.dist.version}" if point.dist is not None else "an unknown distribution"
        warn(f"{owner}: {point.group} entry {point.name!r} ({point.value}) is left out: {import_failure(error)}")
        return None


def import_failure(error: BaseException) -> str:
    """Why an import failed: the error, and the line that it comes from."""
    line = line_of_import(error)
    return f"{type(error).__name__}: {error}{f' ({line.file}:{line.line})' if line is not None else ''}"


def operators_in(module: ModuleType) -> dict[str, Operator]:
    """The operators among a module's names, by their own names."""
    declared = (operator_of(value) for value in vars(module).values())
    return {operator.name: operator for operator in declared if operator is not None}


def types_in(module: ModuleType) -> dict[str, Any]:
    """The types among a module's public names: classes that it defines, and arrays with a meaning."""
    return {
        name: value
        for name, value in vars(module).items()
        if not name.startswith("_")
        and ((isinstance(value, type) and value.__module__ == module.__name__) or array_of(value) is not None)
    }


def files_in(module: ModuleType) -> dict[Any, Files]:
    """How a module says that its types are read from and written to files: `FILES`, a table from types to `Files`."""
    return getattr(module, "FILES", {})


def pictures_in(module: ModuleType) -> dict[Any, Draw]:
    """How a module says that values of its types are drawn: `PICTURES`, a table from types to functions."""
    return getattr(module, "PICTURES", {})


def import_file(path: Path) -> ModuleType:
    """A plug-in file as a module; the one that was imported before, where the file is what it was.

    Executed again it would be other code: its functions would have other fingerprints, and no result of theirs would be
    found in a cache.

    Raises:
        PluginError: the file is missing, or fails to import.
    """
    name = f"graphface_plugin_{path.stem}"
    try:
        text = path.read_bytes()
    except OSError:
        raise PluginError(f"{path}: no such plug-in file", path=path) from None
    before = sys.modules.get(name)
    if before is not None and _imported.get(name) == (path.resolve(), text):
        return before
    spec = importlib.util.spec_from_file_location(name, path, loader=_FromSource(name, str(path)))
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[name]
        raise PluginError(f"{path}: {import_failure(error)}", path=path) from error
    _imported[name] = path.resolve(), text
    return module


_imported: dict[str, tuple[Path, bytes]] = {}
"""By module name: the plug-in file that it was made from, and what stood in it."""


class _FromSource(SourceFileLoader):
    """Compiles the file as it is now: a stored compilation counts as current for a second after an edit."""

    def get_code(self, fullname: str) -> CodeType:
        path = self.get_filename(fullname)
        return self.source_to_code(self.get_data(path), path)


def _as_pack(named: object) -> Pack:
    """A pack as it is, or one of a module's operators and types."""
    if isinstance(named, Pack):
        return named
    if not isinstance(named, ModuleType):
        raise TypeError(f"it is a {type(named).__name__}, neither a Pack nor a module")
    operators = operators_in(named)
    if not operators:
        raise TypeError("the module declares no operator; put @node on a function")
    types = types_in(named)
    return Pack(
        named.__name__,
        operators={operator.family: named.__name__ for operator in operators.values()},
        types={name: f"{named.__name__}:{name}" for name in types},
        files={name: f"{named.__name__}:FILES" for name, kind in types.items() if kind in files_in(named)},
        pictures={name: f"{named.__name__}:PICTURES" for name, kind in types.items() if kind in pictures_in(named)},
        formerly={old: operator.name for operator in operators.values() for old in operator.formerly},
    )
