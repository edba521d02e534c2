"""One graph over many inputs: every combination of the files that stand for its mapped inputs.

    for made in run_over(graph, evaluator, {"photo": photos, "reference": references}, {}):
        made.inputs, made.result

Nothing here shares work by itself: every combination is an ordinary run, and the evaluator's memory tier knows what was
computed before by its key. So 10 photos under 10 references compute 20 representations, as long as they fit into the
tier's budget; the last input named varies fastest, so that of the others one value at a time is needed.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from graphface.errors import GraphfaceError, InputError, RunError, UnreadableFile, UsageError, nearest_names
from graphface.evaluate.evaluator import Evaluator, Result
from graphface.graph.request import request
from graphface.graph.wired import WiredGraph


@dataclass(frozen=True)
class Made:
    """One combination: the inputs it was run with, and its result or what went wrong."""

    inputs: dict[str, Any]
    result: Result | None = None
    error: GraphfaceError | None = None


class MapFailed(RunError):
    """Some combinations failed; `failures` has each. The others were made."""

    def __init__(self, failures: Sequence[Made], total: int) -> None:
        self.failures: list[Made] = list(failures)
        self.total = total
        lines = [f"{len(failures)} of {total} combinations failed:"]
        for made in failures[:5]:
            named = ", ".join(f"{name}={value}" for name, value in made.inputs.items())
            lines.append(f"  {named}: {str(made.error).partition(chr(10))[0]}")
        if len(failures) > 5:
            lines.append(f"  and {len(failures) - 5} more")
        super().__init__("\n".join(lines))


def run_over(
    graph: WiredGraph,
    evaluator: Evaluator,
    maps: Mapping[str, Sequence[Any]],
    given: Mapping[str, Any],
    outputs: Iterable[str] | None = None,
) -> Iterator[Made]:
    """Run the graph for every combination of the values in `maps`, with `given` for its other inputs.

    A combination that fails is told and does not stop the others; Ctrl-C does.

    Raises:
        InputError: the graph has no input of a name, or it is both mapped and given.
    """
    for name in maps:
        if name not in graph.inputs:
            has = ", ".join(graph.inputs) or "none"
            raise InputError(name, f"the graph has no such input (it has {has})", nearest_names(name, graph.inputs))
        if name in given:
            raise InputError(name, "is both given and mapped over")
    asked = list(outputs) if outputs is not None else None
    for values in itertools.product(*maps.values()):
        inputs = {**given, **dict(zip(maps, values, strict=True))}
        try:
            yield Made(inputs, evaluator.run(request(graph, inputs, asked)))
        except GraphfaceError as error:
            yield Made(inputs, error=error)


def read_map(text: str) -> tuple[str, list[str]]:
    """A "NAME=WHERE" flag: an input and the files of `files_at`.

    Raises:
        UsageError: the text is not of that form. UnreadableFile: there is no such folder, or no file in it.
    """
    name, equals, where = text.partition("=")
    if not (name and equals and where):
        raise UsageError(f"--map {text!r}: expected NAME=FOLDER or NAME=PATTERN")
    try:
        return name, files_at(where)
    except UnreadableFile as error:
        raise UnreadableFile(where, f"{error.reason} (--map {name})") from None


def files_at(where: str) -> list[str]:
    """The files of a folder, or those that a pattern like photos/*.png matches, by name.

    Files whose names begin with a dot are left out.

    Raises:
        UnreadableFile: there is no such folder, or no file in it.
    """
    try:
        candidates = _matching(Path(where))
        if candidates is None:
            raise UnreadableFile(where, "is neither a folder nor a pattern in one")
        files = sorted(str(f) for f in candidates if f.is_file() and not f.name.startswith("."))
    except OSError as error:  # a folder that may not be looked into
        raise UnreadableFile(where, error.strerror or str(error)) from None
    if not files:
        raise UnreadableFile(where, "holds no file")
    return files


def read_maps(texts: Sequence[str]) -> dict[str, list[str]]:
    """Several flags; see `read_map`.

    Raises:
        UsageError: an input is mapped twice.
    """
    maps: dict[str, list[str]] = {}
    for text in texts:
        name, files = read_map(text)
        if name in maps:
            raise UsageError(f"--map {text!r}: input {name!r} is mapped twice")
        maps[name] = files
    return maps


def _matching(where: Path) -> Iterator[Path] | None:
    """What a folder holds or a pattern matches; None where it is neither."""
    if where.is_dir():
        return where.iterdir()
    if any(c in where.name for c in "*?[") and where.parent.is_dir():
        return where.parent.glob(where.name)
    return None
