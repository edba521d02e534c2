"""The graph and the inputs of an earlier run, from what it left: a trace (`run.json`) or a run report.

Both keep the effective document, and of every input where it came from and the digest of its content. What is bound
again is what the run had, or nothing: a file that is gone or that is not what it was is an error.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from graphface.errors import UnreadableFile, UsageError
from graphface.graph.inputs import Bound
from graphface.graph.wired import WiredGraph
from graphface.report.page.read import read_report

SUFFIXES = (".json", ".html")


@dataclass(frozen=True)
class Recorded:
    """What an earlier run left.

    Attributes:
        path: of the file. document: the effective graph, as YAML. inputs: by name "origin", "digest" and, of a number
            or text, "value". nodes: what became of each. pinned: those that had a given value.
    """

    path: Path
    document: str
    inputs: Mapping[str, Mapping[str, Any]]
    nodes: tuple[Mapping[str, Any], ...]
    pinned: tuple[str, ...] = ()


def read_recorded(path: Path) -> Recorded:
    """Read a trace, or the one inside a report.

    Raises:
        UnreadableFile: it is neither.
    """
    try:
        held = read_report(path) if path.suffix.lower() == ".html" else json.loads(path.read_text(encoding="utf-8"))
        return Recorded(
            path, str(held["document"]), dict(held["inputs"]), tuple(held["nodes"]), tuple(held.get("pinned", ()))
        )
    except OSError as error:
        raise UnreadableFile(path, error.strerror or str(error)) from None
    except (ValueError, KeyError, TypeError) as error:
        raise UnreadableFile(path, f"is no trace of a run, as --trace writes it ({error!r})") from None


def bound_again(graph: WiredGraph, recorded: Recorded, given: Mapping[str, Any]) -> dict[str, Any]:
    """The inputs of the run, with `given` in place of some.

    Args:
        graph: that of the recorded document, or another: inputs that it lacks are left out.

    Raises:
        UsageError: an input cannot be had again, or is not what it was; values stood in for nodes.
    """
    if recorded.pinned:
        raise UsageError(f"{recorded.path}: values were given for {', '.join(recorded.pinned)}; compare a run without")
    inputs = dict(given)
    for name, before in recorded.inputs.items():
        if name in graph.inputs and name not in given:
            inputs[name] = _again(graph, recorded, name, before)
    return inputs


def _again(graph: WiredGraph, recorded: Recorded, name: str, before: Mapping[str, Any]) -> Bound:
    if "value" in before:
        return graph.bind({name: before["value"]})[name]
    origin, digest = str(before.get("origin")), before.get("digest")
    default = graph.bind({}).get(name)
    if default is not None and default.digest.hex() == digest:
        return default
    places = [Path(origin), recorded.path.parent / origin]
    found = next((place for place in places if place.is_file()), None)
    if found is None:
        looks_like_file = "/" in origin or "\\" in origin or "." in origin
        why = f"{origin} is gone" if looks_like_file else f"it was a value from Python ({origin}), which no file holds"
        raise UsageError(f"{recorded.path}: input {name!r}: {why}; give it with -i {name}=FILE")
    bound = graph.bind({name: found})[name]
    if bound.digest.hex() != digest:
        raise UsageError(
            f"{recorded.path}: input {name!r}: {found} is not what it was in that run (its content, or the code that "
            f"reads it, has changed); to compare with it as it is, give it with -i {name}={found}"
        )
    return bound
