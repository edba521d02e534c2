"""What a graph's nodes were made of when their values were last had: the memory of `graphface explain`.

A node's *identity* is what its key is made of, kept apart: operator, code, parameters, and the keys of its inputs. The
identities of a run are remembered by the graph's name, in the cache folder where there is one, and say in the next run
what has changed. They are a courtesy: unreadable or unwritable, it is as if there were none.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphface.cache.folder import MARK
from graphface.errors import UnwritableFile
from graphface.evaluate.observe import Observer, Record
from graphface.graph.inputs import Bound
from graphface.graph.keys import CODE
from graphface.graph.wiring import Ref
from graphface.values.writing import beside

if TYPE_CHECKING:
    from graphface.cache.disk import DiskTier
    from graphface.graph.graph import Graph
    from graphface.node import Operator


@dataclass
class Identity:
    """What a node's key is made of.

    `inputs` maps each port to the (reference, key) pairs plugged into it. `failed` where the node failed when it last
    ran; `stored` where the value had a place in a cache when that run was over, or had lost it by then.
    """

    operator: str
    code: str
    parameters: dict[str, str]
    inputs: dict[str, list[list[str]]]
    key: str
    failed: bool = False
    stored: bool = True


def identities(graph: Graph, bound: Mapping[str, Bound], targets: Mapping[str, Ref]) -> dict[str, Identity]:
    """The identity of every node that `targets` may need."""
    keys = graph.keys(bound)
    names = [*graph.inputs, *(step.name for step in graph.steps)]
    code: dict[Operator, str] = {}
    found = {}
    for step in graph.steps_behind(targets.values()):
        operator = step.operator
        if operator not in code:
            code[operator] = CODE.digest(operator).hex()
        kept = {n: _text(v) for n, v in step.parameters.items() if n not in operator.cosmetic}
        inputs = {
            a.port: [[".".join((names[r.slot], *r.fields)), keys[r.slot].hex()] for r in a.refs] for a in step.arguments
        }
        found[step.name] = Identity(operator.name, code[operator], kept, inputs, keys[step.slot].hex())
    return found


class History:
    """The identities that the nodes of each graph had when last run.

    Args:
        folder: where they are kept between processes; None keeps them in this one.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder
        self._held: dict[str, dict[str, Identity]] = {}

    @classmethod
    def beside(cls, cache: Path | None) -> History:
        """The history kept in the folder of a disk tier."""
        return cls(cache / "history" if cache is not None else None)

    def last(self, name: str) -> dict[str, Identity]:
        """The identities by node, empty where the graph never ran or the file cannot be read."""
        if name in self._held or self._folder is None:
            return self._held.get(name, {})
        try:
            stored = json.loads(self._file(name).read_text(encoding="utf-8"))
            return {node: Identity(**parts) for node, parts in stored.items()}
        except (OSError, ValueError, TypeError, AttributeError):
            return {}

    def learn(self, name: str, taken: Mapping[str, Identity]) -> None:
        """Replace what is known of the nodes in `taken`; of others it is kept."""
        self._held[name] = {**self.last(name), **taken}
        self._store(name)

    def _store(self, name: str) -> None:
        if self._folder is None or not (self._folder.parent / MARK).is_file():
            return  # nothing was stored yet; a file of ours there would make the disk tier refuse the folder as foreign
        try:
            self._folder.mkdir(exist_ok=True)
            with beside(self._file(name)) as path:
                path.write_text(json.dumps({n: vars(i) for n, i in self._held[name].items()}), encoding="utf-8")
        except (OSError, UnwritableFile):
            return

    def _file(self, name: str) -> Path:
        assert self._folder is not None
        digest = hashlib.blake2b(name.encode("utf-8", "replace"), digest_size=4).hexdigest()
        return self._folder / f"{re.sub(r'[^A-Za-z0-9_-]', '_', name)[:60]}-{digest}.json"


class Remember(Observer):
    """Lets a history learn from the runs of one request, also from one that failed or was interrupted."""

    def __init__(
        self,
        history: History,
        graph: Graph,
        bound: Mapping[str, Bound],
        targets: Mapping[str, Ref],
        disk: DiskTier | None,
    ) -> None:
        self._history = history
        self._graph = graph
        self._bound = bound
        self._targets = targets
        self._disk = disk

    def run_finished(self, records: Sequence[Record]) -> None:
        now = identities(self._graph, self._bound, self._targets)
        by_key = {record.key.hex(): record for record in records if record.state != "declined"}
        evicting: bool | None = None
        taken = {}
        for name in _had(self._graph, self._targets, records, self._graph.keys(self._bound)):
            identity = taken[name] = now[name]
            record = by_key.get(identity.key)
            if record is None:
                continue
            identity.failed = record.state == "failed"
            if self._disk is not None and record.state == "ran" and not self._disk.contains(record.key):
                evicting = self._disk.stats().evicted > 0 if evicting is None else evicting
                identity.stored = evicting
        self._history.learn(self._graph.name, taken)


def _had(graph: Graph, targets: Mapping[str, Ref], records: Sequence[Record], keys: Sequence[bytes]) -> list[str]:
    """The nodes whose values a run had, in its hands or behind a memoized value, and those that failed.

    What was blocked, declined or not reached before an interruption was not had: the next run is the first to see it.
    """
    first = len(graph.inputs)
    states = {record.key: record.state for record in records if record.state != "declined"}
    declined = {record.name for record in records if record.state == "declined"}
    names: dict[str, None] = {}
    seen: dict[int, bool] = {}
    stack = [(ref.slot, False) for ref in targets.values()]
    while stack:
        slot, behind = stack.pop()
        if slot < first or seen.get(slot, False) or (slot in seen and not behind):
            continue
        seen[slot] = behind
        step, state = graph.steps[slot - first], states.get(keys[slot])
        if behind or state in ("ran", "memory", "disk", "failed"):
            names[step.name] = None
        above = list(step.eager)
        if state == "ran":
            wanted = (a for a in step.arguments if a.lazy and f"{step.name}.{a.port}" not in declined)
            above += [ref.slot for argument in wanted for ref in argument.refs]
        memoized = state in ("memory", "disk") or (behind and state is None)
        stack.extend((parent, memoized) for parent in above)
    return list(names)


def _text(value: Any) -> str:
    """A parameter for reading; long ones are cut, with a digest of the whole so that they still differ."""
    text = repr(value)
    if len(text) <= 200:
        return text
    return f"{text[:180]}... ({hashlib.blake2b(text.encode('utf-8', 'replace'), digest_size=4).hexdigest()})"
