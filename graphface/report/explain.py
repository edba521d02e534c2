"""Why each node ran or did not: the plan of a request beside what was known of the last one.

The first difference between a node's identity then and now (`graphface.report.history`) is the reason. Where nothing
differs and the value is gone all the same, it was evicted, or its stored form was damaged.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

from graphface.evaluate.evaluator import Evaluator
from graphface.evaluate.observe import Observer
from graphface.evaluate.plan import Fate, plan
from graphface.evaluate.reason import NO_REASON, Reason
from graphface.graph.request import Request
from graphface.graph.structure import Step
from graphface.record import Record, State
from graphface.report.changes import changes
from graphface.report.history import History, Identity, identities
from graphface.values.frozen import arrays_in


@dataclass(frozen=True)
class Explained:
    """One node of a request: what became (or would become) of it, and why.

    `fate` is that of the plan, after a run the state of its record; `otherwise` is why the node would run where the
    plan says that it does not.
    """

    name: str
    operator: str
    fate: Fate | State
    reason: Reason
    key: str
    milliseconds: float | None = None
    bytes: int | None = None
    warnings: tuple[str, ...] = ()
    otherwise: Reason = NO_REASON

    def as_json(self) -> dict[str, Any]:
        parts = {f.name: getattr(self, f.name) for f in fields(self) if f.name != "otherwise"}
        return {**parts, "reason": str(self.reason), "because": self.reason.as_json()}


class Sizes(Observer):
    """Gives the records of memoized values their bytes, which a run does not count."""

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        if record.state in ("memory", "disk"):
            record.bytes = sum(array.nbytes for _, array in arrays_in(value))


def explain(request: Request, evaluator: Evaluator, history: History) -> list[Explained]:
    """Every node with its fate and the reason, before the request is run."""
    before = history.last(request.graph.name)
    now = identities(request)
    pinned = {request.graph.names[slot] for slot in request.pinned}
    changed = {name for name in now if name in before and before[name].key != now[name].key}
    explained = []
    for entry in plan(request, evaluator):
        known, identity = before.get(entry.name), now.get(entry.name)
        why = _why(known, identity, changed, pinned, evaluator) if identity is not None else NO_REASON
        reason = entry.reason
        if entry.fate == "run":
            reason = why
        elif entry.fate in ("memory", "disk"):
            same = known is not None and identity is not None and known.key == identity.key
            reason = Reason("unchanged" if same else "elsewhere")
        explained.append(Explained(entry.name, entry.operator, entry.fate, reason, entry.key, otherwise=why))
    return explained


def with_results(
    explained: Sequence[Explained], records: Sequence[Record], damaged: Sequence[str] = ()
) -> list[Explained]:
    """The same after the run: what happened, in which time and with how many bytes.

    Args:
        damaged: what the disk tier reported; an entry it dropped is named there by its key.
    """
    by_name = {record.name: record for record in records}
    by_key = {record.key.hex()[:8]: record for record in records if record.state != "declined"}
    joined = []
    for entry in explained:
        record = by_name.get(entry.name)
        twin = by_key.get(entry.key) if entry.fate != "skipped" else None
        if record is not None:
            joined.append(_with_record(entry, record, damaged))
        elif twin is not None:
            joined.append(_resolved(entry, twin.state, Reason("twin", node=twin.name)))
        elif entry.fate == "maybe":
            joined.append(_resolved(entry, "skipped", _declined(entry.reason.node, records)))
        elif entry.fate == "skipped":
            joined.append(entry)
        else:
            joined.append(_resolved(entry, "skipped", Reason("not reached")))
    return joined


def _with_record(entry: Explained, record: Record, damaged: Sequence[str]) -> Explained:
    if entry.fate == "pinned":
        return entry
    ran = record.state in ("ran", "failed")
    reason = entry.reason if entry.fate in ("run", "memory", "disk") else entry.otherwise
    if record.state == "failed":
        reason = Reason("failed", new=record.reason)
    elif record.state == "blocked":
        reason = Reason("blocked")
    elif ran and any(record.key.hex() in message for message in damaged):
        reason = Reason("damaged")
    elif ran and entry.fate in ("memory", "disk"):
        reason = Reason("gone")
    elif not ran and entry.fate not in ("memory", "disk"):
        reason = Reason("elsewhere")
    milliseconds = record.seconds * 1e3 if ran else None
    size = record.bytes if record.state in ("ran", "memory", "disk") else None
    warnings = tuple(record.warnings)
    return Explained(entry.name, entry.operator, record.state, reason, entry.key, milliseconds, size, warnings)


def _resolved(entry: Explained, fate: Fate | State, reason: Reason) -> Explained:
    return Explained(entry.name, entry.operator, fate, reason, entry.key)


def _declined(decider: str, records: Sequence[Record]) -> Reason:
    """What the node that was to decide said."""
    for record in records:
        node, _, port = record.name.rpartition(".")
        if record.state == "declined" and node == decider:
            return Reason("declined", node=node, port=port, new=record.reason)
    return Reason("not reached")


def _why(before: Identity | None, now: Identity, changed: set[str], pinned: set[str], evaluator: Evaluator) -> Reason:
    """The first difference between a node's last identity and this one; where there is none, how its value got lost."""
    if before is None:
        return Reason("first seen")
    if before.key == now.key:
        return _lost(before, evaluator)
    return next(changes(before, now, changed, pinned), Reason("lazy ports"))


def _lost(before: Identity, evaluator: Evaluator) -> Reason:
    if before.failed:
        return Reason("failed before")
    if evaluator.memory is None and evaluator.disk is None:
        return Reason("no cache")
    evicted = evaluator.memory is not None and evaluator.memory.was_evicted(bytes.fromhex(before.key))
    if evicted or (evaluator.disk is not None and before.stored):
        return Reason("evicted")
    return Reason("not kept")
