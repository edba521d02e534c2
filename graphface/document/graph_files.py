"""Where graph files are: one asked for by path or by a shipped graph's name, and those that a graph file names.

A graph file names other files only below the folder of the file that was asked for, or among the graphs that installed
packs ship: a graph from a stranger cannot reach into the rest of the disk.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from graphface.document.document import Document, read_document
from graphface.errors import DocumentError, Problem, UnreadableFile, did_you_mean, nearest_names
from graphface.fallback import warn
from graphface.place import Place

GRAPH_SUFFIXES = (".yaml", ".yml")


def find_graph(name: str, shipped: Sequence[Path]) -> Path:
    """The file of a graph given on the command line: a path, or the name of a shipped graph ("relight").

    A bare name means the shipped graph, also where a file here is called like it: that is warned of.

    Raises:
        UnreadableFile: neither exists; the message lists the shipped ones.
    """
    path = Path(name)
    here = _is_file(path)
    candidates = (c for d in shipped for c in (d / name, *(d / f"{name}{s}" for s in GRAPH_SUFFIXES)))
    ours = next((candidate for candidate in candidates if _is_file(candidate)), None)
    if ours is not None and (not here or name == path.stem):
        if here:
            warn(f"{name!r} is the shipped graph; the file of that name in this folder is ./{name}")
        return ours
    if here:
        return path
    known = shipped_graphs(shipped)
    hint = f" (shipped graphs: {', '.join(known)})" if known else ""
    near = did_you_mean(nearest_names(path.stem, known))
    raise UnreadableFile(name, f"no such graph file{near}{hint}")


def shipped_graphs(shipped: Sequence[Path]) -> list[str]:
    return sorted(p.stem for folder in shipped for s in GRAPH_SUFFIXES for p in folder.glob(f"*{s}"))


class GraphFiles:
    """The files that one graph is composed of, each read once.

    Args:
        top: the graph that was asked for; others may lie beside it and below.
        shipped: folders of graph files that installed packs offer.
        problems: gets what is wrong with a file, or with its name.
    """

    def __init__(self, top: Document, shipped: Sequence[Path], problems: list[Problem]) -> None:
        self._shipped = [folder.resolve() for folder in shipped]
        self._roots = [_folder(top.path).resolve(), *self._shipped]
        self._problems = problems
        self._read: dict[Path, Document] = {}

    def load(self, name: str, near: Document, place: Place | None) -> Document | None:
        """The document that a file names, looked for beside the file that says so and then among the shipped graphs.

        Args:
            near: the document in which `name` stands, where its place does not tell the file.
        """
        naming = (place.source.path if place is not None else None) or near.path
        for base in (_folder(naming), *self._shipped):
            if _is_file(base / name):
                return self._loaded((base / name).resolve(), name, place)
        known = shipped_graphs(self._roots)
        nearest = tuple(f"{n}.yaml" for n in nearest_names(Path(name).stem, known))
        self._problems.append(Problem(f"no graph file {name!r}", place, nearest))
        return None

    @property
    def read(self) -> list[Path]:
        """The files that were read, besides the one that was asked for."""
        return list(self._read)

    def _loaded(self, path: Path, name: str, place: Place | None) -> Document | None:
        if not any(path.is_relative_to(root) for root in self._roots):
            self._problems.append(Problem(f"{name!r} lies outside the folder of the graph", place))
            return None
        if path not in self._read:
            try:
                document, problems = read_document(path)
            except (UnreadableFile, DocumentError) as error:
                self._problems.append(Problem(f"{name!r} cannot be used", place))
                self._problems += error.problems if isinstance(error, DocumentError) else [Problem(str(error))]
                return None
            self._problems += problems
            self._read[path] = document
        return self._read[path]


def _folder(path: Path | None) -> Path:
    """Where a graph's names of files start: beside it; for a text that is no file, where the process runs."""
    return path.parent if path is not None else Path.cwd()


def _is_file(path: Path) -> bool:
    """Whether there is such a file; a name that no file could have (too long, a NUL in it) is none."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False
