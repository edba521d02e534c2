"""Why each node ran or did not: the plan of a request beside what was known of the last one.

A node's *identity* is what its key is made of, kept apart: operator, code, parameters, and the keys of its inputs. The
identities of a run are remembered per graph, in the cache folder where there is one; the first difference between then
and now is the reason. Where nothing differs and the value is gone all the same, it was evicted or damaged.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphface.cache.keys import CODE
from graphface.evaluate import Evaluator
from graphface.inputs import Bound
from graphface.observe import Record
from graphface.outputs import beside
from graphface.plan import Fate, plan
from graphface.wiring import Ref

if TYPE_CHECKING:
    from graphface.graph import Graph

_RAN = ("ran", "failed")


@dataclass(frozen=True)
class Identity:
    """What a node's key is made of; `inputs` maps each port to the (name, key) pairs plugged into it."""

    operator: str
    code: str
    parameters: dict[str, str]
    inputs: dict[str, list[list[str]]]
    key: str


@dataclass(frozen=True)
class Explained:
    """One node of a request: what became (or would become) of it, and why."""

    name: str
    operator: str
    fate: Fate | str
    reason: str
    key: str
    milliseconds: float | None = None
    bytes: int | None = None
    warnings: tuple[str, ...] = field(default=())

    def as_json(self) -> dict[str, Any]:
        return asdict(self)


class History:
    """The identities of the last run of each graph.

    Args:
        folder: where they are kept between processes; None keeps them in this one.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder
        self._held: dict[str, dict[str, Identity]] = {}

    def last(self, name: str) -> dict[str, Identity]:
        """The identities by node, empty where the graph never ran or the file cannot be read."""
        if name in self._held or self._folder is None:
            return self._held.get(name, {})
        try:
            stored = json.loads(self._file(name).read_text(encoding="utf-8"))
            return {node: Identity(**parts) for node, parts in stored.items()}
        except (OSError, ValueError, TypeError):
            return {}

    def remember(self, name: str, identities: Mapping[str, Identity]) -> None:
        """Replace what is known; nodes that this request did not reach keep what was known of them."""
        merged = {**self.last(name), **identities}
        self._held[name] = merged
        if self._folder is not None:
            try:
                self._folder.mkdir(parents=True, exist_ok=True)
                with beside(self._file(name)) as path:
                    path.write_text(json.dumps({n: asdict(i) for n, i in merged.items()}), encoding="utf-8")
            except OSError:
                return

    def _file(self, name: str) -> Path:
        assert self._folder is not None
        return self._folder / f"{re.sub(r'[^A-Za-z0-9_-]', '_', name)}.json"


def identities(graph: Graph, bound: Mapping[str, Bound], targets: Mapping[str, Ref]) -> dict[str, Identity]:
    """The identity of every node that `targets` may need."""
    keys = graph.keys(bound)
    first = len(graph.inputs)
    names = [*graph.inputs, *(step.name for step in graph.steps)]
    found = {}
    for slot in graph.behind(targets.values()):
        if slot < first:
            continue
        step = graph.steps[slot - first]
        kept = {n: _text(v) for n, v in step.parameters.items() if n not in step.operator.cosmetic}
        inputs = {a.port: [[names[r.slot], keys[r.slot].hex()] for r in a.refs] for a in step.arguments}
        found[step.name] = Identity(
            step.operator.name, CODE.digest(step.operator).hex(), kept, inputs, keys[slot].hex()
        )
    return found


def explain(
    graph: Graph, bound: Mapping[str, Bound], targets: Mapping[str, Ref], evaluator: Evaluator, history: History
) -> list[Explained]:
    """Every node with its fate and the reason, before the request is run."""
    before = history.last(graph.name)
    now = identities(graph, bound, targets)
    changed = {name for name in now if name in before and before[name].key != now[name].key}
    explained = []
    for entry in plan(graph, bound, targets, evaluator):
        reason = entry.reason
        if entry.fate in ("run", "maybe"):
            why = _why(before.get(entry.name), now[entry.name], changed, evaluator)
            reason = f"{why}; {reason}" if reason else why
        elif entry.fate in ("memory", "disk"):
            known = before.get(entry.name)
            same = known is not None and known.key == now[entry.name].key
            reason = "nothing changed" if same else "computed before, by another run or graph"
        explained.append(Explained(entry.name, entry.operator, entry.fate, reason, entry.key))
    return explained


def with_results(
    explained: Sequence[Explained], records: Sequence[Record], said: Sequence[str] = ()
) -> list[Explained]:
    """The same after the run: what happened, in which time and with how many bytes.

    Args:
        said: what the disk tier reported; an entry it dropped as damaged is named there by its key.
    """
    by_name = {record.name: record for record in records}
    joined = []
    for entry in explained:
        record = by_name.get(entry.name)
        if record is None:
            fate = "skipped" if entry.fate == "maybe" else entry.fate
            reason = _declined_reason(records) if entry.fate == "maybe" else entry.reason
            joined.append(Explained(entry.name, entry.operator, fate, reason, entry.key))
            continue
        reason = entry.reason
        if record.state in _RAN and any(record.key.hex() in message for message in said):
            reason = "its stored result was damaged"
        elif record.state in ("failed", "blocked"):
            reason = record.reason or "a node above it failed"
        milliseconds = record.seconds * 1e3 if record.state in _RAN else None
        joined.append(
            Explained(
                entry.name, entry.operator, record.state, reason, entry.key, milliseconds, record.bytes, tuple(record.warnings)
            )
        )
    return joined


def _why(before: Identity | None, now: Identity, changed: set[str], evaluator: Evaluator) -> str:
    """The first difference between a node's last identity and this one."""
    if before is None:
        return "first seen"
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
    if before.key != now.key:
        return "which lazy inputs it takes changed"
    if evaluator.memory is not None and bytes.fromhex(now.key) in evaluator.memory.evicted:
        return "evicted"
    return "not kept since it last ran (evicted, damaged, or no cache in use)"


def _input_change(port: str, before: list[list[str]], now: list[list[str]], changed: set[str]) -> str:
    names_before, names_now = [name for name, _ in before], [name for name, _ in now]
    if names_before != names_now:
        here, there = (", ".join(names) or "nothing" for names in (names_now, names_before))
        return f"port {port} is connected to {here}, was {there}"
    culprit = next(name for (name, new), (_, old) in zip(now, before, strict=True) if new != old)
    return f"{culprit} changed above it" if culprit in changed else f"input {culprit} changed"


def _declined_reason(records: Sequence[Record]) -> str:
    return next((r.reason for r in records if r.state == "declined"), "its node declined it")


def _text(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 200 else text[:197] + "..."


def history_folder(cache: Path | None) -> Path | None:
    """Where identities are kept beside a disk tier."""
    return Path(os.fspath(cache)) / "history" if cache is not None else None
