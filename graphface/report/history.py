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
from typing import Any

from graphface.cache.disk import DiskTier
from graphface.cache.folder import MARK
from graphface.errors import UnwritableFile
from graphface.evaluate.observe import Observer
from graphface.graph.demand import demanded, reached
from graphface.graph.request import Request
from graphface.record import Record
from graphface.values.writing import beside

PINNED = "pinned"
"""The operator of a node that a given value stands in for."""


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


def identities(request: Request) -> dict[str, Identity]:
    """The identity of every node that the request's targets may need; that of a pinned one is the value's."""
    names, keys = request.graph.names, request.keys.by_slot
    code = {operator: digest.hex() for operator, digest in request.keys.code.items()}
    found = {}
    for step in request.steps():
        operator = step.operator
        kept = {n: _text(v) for n, v in step.parameters.items() if n not in operator.cosmetic}
        inputs = {
            a.port: [[".".join((names[r.slot], *r.fields)), keys[r.slot].hex()] for r in a.refs] for a in step.arguments
        }
        found[step.name] = Identity(operator.name, code[operator], kept, inputs, keys[step.slot].hex())
    for slot in request.pinned:
        found[names[slot]] = Identity(PINNED, "", {}, {}, keys[slot].hex())
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
    """Lets a history learn from one run, also from one that failed or was interrupted."""

    def __init__(self, history: History, disk: DiskTier | None) -> None:
        self._history = history
        self._disk = disk
        self._request: Request | None = None

    def run_started(self, request: Request) -> None:
        self._request = request

    def run_finished(self, records: Sequence[Record]) -> None:
        if self._request is None:
            return
        now = identities(self._request)
        by_key = {record.key.hex(): record for record in records if record.state != "declined"}
        evicting: bool | None = None
        taken = {}
        for name in _had(self._request, records):
            identity = taken[name] = now[name]
            record = by_key.get(identity.key)
            if record is None:
                continue
            identity.failed = record.state == "failed"
            if self._disk is not None and record.state == "ran" and not self._disk.contains(record.key):
                evicting = self._disk.stats().evicted > 0 if evicting is None else evicting
                identity.stored = evicting
        self._history.learn(self._request.graph.name, taken)


def _had(request: Request, records: Sequence[Record]) -> list[str]:
    """The nodes whose values a run had, in its hands or behind a memoized value, and those that failed.

    What was blocked, declined or not reached before an interruption was not had: the next run is the first to see it.
    """
    states = {record.key: record.state for record in records if record.state != "declined"}
    declined: dict[str, dict[str, str]] = {}
    for record in records:
        if record.state == "declined":
            node, _, port = record.name.rpartition(".")
            declined.setdefault(node, {})[port] = record.reason
    had: set[int] = set()

    def above(slot: int) -> tuple[int, ...]:
        """What stands above a slot in the run; of one that did not run, what was surely had before."""
        step = request.step(slot)
        if step is None:
            return ()
        state = states.get(request.key(slot))
        return demanded(step, declined.get(step.name, {}) if state == "ran" else None)[0]

    def memoized(slot: int) -> bool:
        return states.get(request.key(slot)) in ("memory", "disk")

    asked = reached((ref.slot for ref in request.targets.values()), above)
    had.update(slot for slot in asked if states.get(request.key(slot)) in ("ran", "memory", "disk", "failed"))
    had |= reached((slot for slot in asked if memoized(slot)), above)
    steps = (request.graph.step(slot) for slot in sorted(had))
    return [step.name for step in steps if step is not None]


def _text(value: Any) -> str:
    """A parameter for reading; long ones are cut, with a digest of the whole so that they still differ."""
    text = repr(value)
    if len(text) <= 200:
        return text
    return f"{text[:180]}... ({hashlib.blake2b(text.encode('utf-8', 'replace'), digest_size=4).hexdigest()})"
