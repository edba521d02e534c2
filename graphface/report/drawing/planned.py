"""What a plan says about each node, as marks of a drawing."""

from __future__ import annotations

from collections.abc import Iterable

from graphface.evaluate.plan import Planned
from graphface.report.drawing.marks import Mark, MarkState


def marks_of(planned: Iterable[Planned]) -> dict[str, Mark]:
    """A mark for every node: what would run, what is memoized, what is skipped and why."""
    return {entry.name: _mark(entry) for entry in planned}


def _mark(entry: Planned) -> Mark:
    reason = str(entry.reason)
    if entry.fate == "run":
        return Mark("", reason, None, "would run")
    if entry.fate == "maybe":
        return Mark("", reason, None, "may run")
    if entry.fate != "skipped":
        return Mark(entry.fate, reason)
    state: MarkState = "declined" if entry.reason.kind == "declined" else "skipped"
    return Mark(state, reason)
