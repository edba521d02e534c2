"""Why each node ran or did not: the plan of a request beside what was known of the last one.

The first difference between a node's identity then and now (`graphface.report.history`) is the reason. Where nothing differs
and the value is gone all the same, it was evicted, or its stored form was damaged.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from graphface.evaluate.evaluator import Evaluator
from graphface.evaluate.observe import Observer, Record
from graphface.evaluate.plan import Fate, plan
from graphface.graph.inputs import Bound
from graphface.graph.wiring import Ref, Step
from graphface.report.history import History, Identity, identities
from graphface.values.frozen import arrays_in

if TYPE_CHECKING:
    from graphface.graph.graph import Graph

UNCHANGED = "nothing changed"
ELSEWHERE = "computed before, by another run or graph"


@dataclass(frozen=True)
class Explained:
    """One node of a request: what became (or would become) of it, and why.

    `fate` is that of the plan, after a run the state of its record; `otherwise` is why the node would run where the
    plan says that it does not.
    """

    name: str
    operator: str
    fate: Fate | str
    reason: str
    key: str
    milliseconds: float | None = None
    bytes: int | None = None
    warnings: tuple[str, ...] = ()
    otherwise: str = ""

    def as_json(self) -> dict[str, Any]:
        parts = asdict(self)
        del parts["otherwise"]
        return parts


class Sizes(Observer):
    """Gives the records of memoized values their bytes, which a run does not count."""

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        if record.state in ("memory", "disk"):
            record.bytes = sum(array.nbytes for _, array in arrays_in(value))


def explain(
    graph: Graph, bound: Mapping[str, Bound], targets: Mapping[str, Ref], evaluator: Evaluator, history: History
) -> list[Explained]:
    """Every node with its fate and the reason, before the request is run."""
    before = history.last(graph.name)
    now = identities(graph, bound, targets)
    changed = {name for name in now if name in before and before[name].key != now[name].key}
    explained = []
    for entry in plan(graph, bound, targets, evaluator):
        known, identity = before.get(entry.name), now.get(entry.name)
        why = _why(known, identity, changed, evaluator) if identity is not None else ""
        reason = entry.reason
        if entry.fate == "run":
            reason = why
        elif entry.fate in ("memory", "disk"):
            same = known is not None and identity is not None and known.key == identity.key
            reason = UNCHANGED if same else ELSEWHERE
        explained.append(Explained(entry.name, entry.operator, entry.fate, reason, entry.key, otherwise=why))
    return explained


def with_results(
    explained: Sequence[Explained], records: Sequence[Record], said: Sequence[str] = ()
) -> list[Explained]:
    """The same after the run: what happened, in which time and with how many bytes.

    Args:
        said: what the disk tier reported; an entry it dropped as damaged is named there by its key.
    """
    by_name = {record.name: record for record in records}
    by_key = {record.key.hex()[:8]: record for record in records if record.state != "declined"}
    joined = []
    for entry in explained:
        record = by_name.get(entry.name)
        twin = by_key.get(entry.key) if entry.fate != "skipped" else None
        if record is not None:
            joined.append(_with_record(entry, record, said))
        elif twin is not None:
            joined.append(_resolved(entry, twin.state, f"equal to {twin.name}, which was evaluated for both"))
        elif entry.fate == "maybe":
            joined.append(_resolved(entry, "skipped", _declined_reason(entry, records)))
        elif entry.fate == "skipped":
            joined.append(entry)
        else:
            joined.append(_resolved(entry, "skipped", "what needed it failed, or was memoized meanwhile"))
    return joined


def _with_record(entry: Explained, record: Record, said: Sequence[str]) -> Explained:
    ran = record.state in ("ran", "failed")
    reason = entry.reason if entry.fate in ("run", "memory", "disk") else entry.otherwise
    if record.state in ("failed", "blocked"):
        reason = record.reason or "a node above it failed"
    elif ran and any(record.key.hex() in message for message in said):
        reason = "its stored result was damaged"
    elif ran and entry.fate in ("memory", "disk"):
        reason = "its stored result was gone when it was needed"
    elif not ran and entry.fate not in ("memory", "disk"):
        reason = ELSEWHERE
    milliseconds = record.seconds * 1e3 if ran else None
    size = record.bytes if record.state in ("ran", "memory", "disk") else None
    warnings = tuple(record.warnings)
    return Explained(entry.name, entry.operator, record.state, reason, entry.key, milliseconds, size, warnings)


def _resolved(entry: Explained, fate: str, reason: str) -> Explained:
    return Explained(entry.name, entry.operator, fate, reason, entry.key)


def _declined_reason(entry: Explained, records: Sequence[Record]) -> str:
    """What the node that was to decide said; the plan's reason begins with its name."""
    said = (
        record.reason
        for record in records
        if record.state == "declined" and entry.reason.startswith(f"{record.name.rpartition('.')[0]} decides")
    )
    return next(said, "its node declined it, or needed it no more")


def _why(before: Identity | None, now: Identity, changed: set[str], evaluator: Evaluator) -> str:
    """The first difference between a node's last identity and this one; where there is none, how its value got lost."""
    if before is None:
        return "first seen"
    if before.key == now.key:
        return _lost(before, evaluator)
    if before.operator != now.operator:
        return f"operator changed from {before.operator} to {now.operator}"
    if before.code != now.code:
        return "operator code changed"
    for name in {**before.parameters, **now.parameters}:
        old, new = before.parameters.get(name), now.parameters.get(name)
        if old != new:
            return f"parameter {name} changed from {old} to {new}"
    for port in {**before.inputs, **now.inputs}:
        if before.inputs.get(port) != now.inputs.get(port):
            return _input_change(port, before.inputs.get(port, []), now.inputs.get(port, []), changed)
    return "which lazy inputs it takes changed"


def _lost(before: Identity, evaluator: Evaluator) -> str:
    if before.failed:
        return "it failed when it last ran"
    if evaluator.memory is None and evaluator.disk is None:
        return "no cache in use"
    evicted = evaluator.memory is not None and bytes.fromhex(before.key) in evaluator.memory.evicted
    if evicted or (evaluator.disk is not None and before.stored):
        return "evicted"
    return "not kept (too large for the cache, or nothing that it can hold)"


def _input_change(port: str, before: list[list[str]], now: list[list[str]], changed: set[str]) -> str:
    there, here = [name for name, _ in before], [name for name, _ in now]
    if there != here:
        return f"port {port} is connected to {', '.join(here) or 'nothing'}, was {', '.join(there) or 'nothing'}"
    culprit = next(name for (name, new), (_, old) in zip(now, before, strict=True) if new != old).partition(".")[0]
    return f"{culprit} changed above it" if culprit in changed else f"input {culprit} changed"
