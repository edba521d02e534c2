"""Where modules are, and which of them count by their content.

The modules of an operator's own distribution count by content, and so does code that no installer put there: a script,
a plug-in file, a package under development. What was installed counts as "numpy 2.4.6", the standard library not at
all; nor does the engine (see `graphface.fingerprint.RESULT_FORMAT`). Nothing is imported in order to be looked at.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Sequence
from functools import cache
from importlib import metadata
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path

_ENGINE, _NODES = "graphface", "graphface.nodes"
_INSTALLED = frozenset({"site-packages", "dist-packages"})


def distribution(module: str) -> str:
    """The top-level name of a module; the face operators are a distribution of their own, though shipped together."""
    return _NODES if f"{module}.".startswith(_NODES + ".") else module.partition(".")[0]


@cache
def released(module: str, own: str) -> str | None:
    """What a module counts as: "numpy 2.4.6", "" for the standard library and the engine, None for its content.

    Args:
        own: the distribution whose modules count by content wherever they lie.
    """
    top = distribution(module)
    if top == own:
        return None
    return "" if top in (_ENGINE, "builtins") or top in sys.stdlib_module_names else _version(top)


def locate(module: str) -> Path | None:
    """The file of a module; None where there is none."""
    file = getattr(sys.modules.get(module), "__file__", None)
    if file is None:
        try:
            spec = _spec(module)
        except (ImportError, ValueError):  # not a name that a module can have
            return None
        file = spec.origin if spec is not None and spec.has_location else None
    return Path(file) if file is not None else None


def imported(module: str, names: Sequence[str], own: str) -> list[str]:
    """The modules that `import module` or `from module import names` reads: a name may be a module itself."""
    inner = [f"{module}.{name}" for name in names]
    if released(module, own) is not None:
        return [_NODES] if _NODES in inner else [module]
    found = [name for name in inner if locate(name) is not None]
    return found if found and found == inner else [*found, module]


def absolute(module: str, package: str) -> str:
    """The full name of a module that an import in `package` names, with dots before it where that is relative."""
    try:
        return importlib.util.resolve_name(module, package)
    except ImportError:  # relative, outside any package
        return module.lstrip(".")


def _spec(module: str) -> ModuleSpec | None:
    loaded = sys.modules.get(module)
    if loaded is not None:
        return loaded.__spec__
    parent, _, name = module.rpartition(".")
    if not parent:
        return importlib.util.find_spec(module)
    above = _spec(parent)
    folders = above.submodule_search_locations if above is not None else None
    return PathFinder.find_spec(name, list(folders)) if folders is not None else None


@cache
def _version(top: str) -> str | None:
    """ "name version" of an installed package, None where no installer put it there."""
    file = locate(top)
    if file is None or _INSTALLED.isdisjoint(file.parts):
        return None
    found: metadata.Distribution | None
    try:
        found = metadata.distribution(top.partition(".")[0])
    except metadata.PackageNotFoundError:  # the distribution of cv2, PIL or skimage has another name
        folder = next(parent for parent in file.parents if parent.name in _INSTALLED)
        listed = f"\n{file.relative_to(folder).as_posix()},"
        found = next((one for one, record in _records(folder) if listed in record), None)
    # `found.version` would parse the whole description of the package
    header = (found.read_text("METADATA") if found is not None else None) or ""
    version = header.partition("\nVersion: ")[2].partition("\n")[0]
    return f"{top} {version}"


@cache
def _records(folder: Path) -> list[tuple[metadata.Distribution, str]]:
    """The distributions in a folder, with the files each consists of."""
    found = [metadata.Distribution.at(path) for path in sorted(folder.glob("*.dist-info"))]
    return [(one, "\n" + (one.read_text("RECORD") or "")) for one in found]
