"""Why a run did not touch a node: the reason for a tile without a picture."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from graphface.evaluate.reason import Kind, Reason
from graphface.graph.demand import refused
from graphface.graph.request import Request
from graphface.record import Record


def untouched(request: Request, records: Sequence[Record]) -> dict[int, Reason]:
    """By slot, for every node and input without a record of its own."""
    graph = request.graph
    by_key = {record.key: record for record in records if record.state != "declined"}
    touched = {record.name for record in records}
    twins = {
        slot: Reason("twin", node=by_key[request.key(slot)].name)
        for slot, name in enumerate(graph.names)
        if name not in touched and request.key(slot) in by_key
    }
    had = {slot for slot in range(len(graph.names)) if request.key(slot) in by_key}
    reasons: dict[int, Reason] = dict(twins)
    for starts in (_behind_memoized(request, by_key, had), _behind_declined(request, records, had)):
        _spread(request, starts, reasons, had)
    unasked = Reason("not needed", new=", ".join(request.targets))
    behind = set(graph.behind(request.targets.values()))
    for slot in range(len(graph.names)):
        if slot not in had:
            reasons.setdefault(slot, Reason("not reached") if slot in behind else unasked)
    return reasons


def _behind_memoized(request: Request, by_key: Mapping[bytes, Record], had: Iterable[int]) -> dict[int, Reason]:
    """What memoized and pinned nodes would have needed."""
    found: dict[int, Reason] = {}
    for slot in sorted(had, reverse=True):
        step = request.graph.step(slot)
        kind = _why_nothing_above(request, slot, by_key)
        if step is not None and kind is not None:
            for above in (*step.eager, *step.lazy):
                found.setdefault(above, Reason(kind, node=step.name))
    return found


def _why_nothing_above(request: Request, slot: int, by_key: Mapping[bytes, Record]) -> Kind | None:
    if slot in request.pinned:
        return "pinned below"
    return "memoized below" if by_key[request.key(slot)].state in ("memory", "disk") else None


def _behind_declined(request: Request, records: Sequence[Record], had: Iterable[int]) -> dict[int, Reason]:
    """What nodes declined, with what they said."""
    declined: dict[str, dict[str, str]] = {}
    for record in records:
        if record.state == "declined":
            node, _, port = record.name.rpartition(".")
            declined.setdefault(node, {})[port] = record.reason
    found: dict[int, Reason] = {}
    for slot in had:
        step = request.graph.step(slot)
        if step is not None and step.name in declined:
            for above, why in refused(step, declined[step.name]).items():
                found.setdefault(above, Reason("declined", node=step.name, new=f"{step.name} declined it: {why}"))
    return found


def _spread(request: Request, starts: Mapping[int, Reason], reasons: dict[int, Reason], had: set[int]) -> None:
    """Give the start slots their reasons, and what is only needed by one of them the same reason."""
    first = {slot: reason for slot, reason in starts.items() if slot not in had and slot not in reasons}
    reasons.update(first)
    stack = list(first)
    while stack:
        slot = stack.pop()
        step = request.graph.step(slot)
        for above in (*step.eager, *step.lazy) if step is not None else ():
            if above not in had and above not in reasons:
                reasons[above] = reasons[slot]
                stack.append(above)
