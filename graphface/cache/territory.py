"""Whose code is it: which modules count by their content, and which by name and version.

An operator's own distribution counts by content, and so does any code nobody has released: a notebook cell, a script, a
file beside a plug-in. What an installer put there counts as "numpy 2.4.6", read from its metadata without importing it,
so that a package imported late counts as one imported early.
"""

from __future__ import annotations

import os
import sys
import sysconfig
from functools import cache
from importlib import metadata
from importlib.machinery import PathFinder
from pathlib import Path, PurePath

from graphface.cache.beside import place

NODES = "graphface.nodes"


class Territory:
    """The modules that count by content for an operator declared in `modules`."""

    def __init__(self, modules: list[str]) -> None:
        self.roots = {_root(module) for module in modules}
        self.folders = {folder for module in modules if (folder := _plugin_folder(module)) is not None}
        self._packages = sorted({path for root in self.roots for path in _package_folders(root)} | self.folders)
        self._answers: dict[str, str | None] = {}

    def foreign(self, module: str | None) -> str | None:
        """ "name version" of the released package that `module` belongs to; None where it counts by content."""
        if module is None:
            return None
        if module not in self._answers:
            self._answers[module] = None if self._owns(module) else released(module.partition(".")[0])
        return self._answers[module]

    def place(self, path: str | PurePath) -> str | None:
        """`path` relative to the package, or to the folder of a plug-in file, that it lies in; None elsewhere."""
        return place(path, self._packages)

    def _owns(self, module: str) -> bool:
        if _root(module) in self.roots:
            return True
        file = getattr(sys.modules.get(module.partition(".")[0]), "__file__", None)
        return file is not None and os.path.dirname(os.path.abspath(file)) in self.folders


@cache
def released(root: str) -> str | None:
    """ "name version" of the top-level module `root`, or None where nobody released it."""
    if root in sys.stdlib_module_names or root == "builtins":
        return "python"
    if not root:  # a relative import outside any package
        return None
    try:
        return f"{root} {metadata.version(root)}"
    except metadata.PackageNotFoundError:
        pass
    spec = PathFinder.find_spec(root)
    if spec is None or spec.origin is None:
        return None
    package = spec.submodule_search_locations is not None
    folder = Path(spec.origin).parent.parent if package else Path(spec.origin).parent
    line = f"\n{root}/{Path(spec.origin).name}," if package else f"\n{Path(spec.origin).name},"
    for record, text in _records(folder):
        if line in text:
            return f"{root} {metadata.Distribution.at(record.parent).version}"
    version = getattr(sys.modules.get(root), "__version__", "")
    return f"{root} {version}" if str(folder) in _site_folders() else None


@cache
def _records(folder: Path) -> list[tuple[Path, str]]:
    """What each distribution installed into `folder` consists of (cv2, PIL, skimage are named otherwise there)."""
    records = sorted(folder.glob("*.dist-info/RECORD"))
    return [(record, "\n" + record.read_text("utf-8", "replace")) for record in records]


def _root(module: str) -> str:
    """The engine ships with the face operators but is no part of them: a change to a cache must not undo the cache."""
    return NODES if module == NODES or module.startswith(NODES + ".") else module.partition(".")[0]


def _package_folders(root: str) -> set[str]:
    """Where a loaded package lies, as it is named and without symbolic links."""
    named = [os.path.abspath(path) for path in getattr(sys.modules.get(root), "__path__", [])]
    return {*named, *map(os.path.realpath, named)}


def _plugin_folder(module: str) -> str | None:
    """The folder whose modules belong together, for a single file or a script; None for a package."""
    if "." in module:
        return None
    loaded = sys.modules.get(module)
    if hasattr(loaded, "__path__"):
        return None
    file = getattr(loaded, "__file__", None)
    if file is None:
        return os.getcwd() if module == "__main__" else None
    folder = os.path.dirname(os.path.abspath(file))
    return None if folder in _site_folders() else folder


@cache
def _site_folders() -> frozenset[str]:
    return frozenset(sysconfig.get_paths().values())
