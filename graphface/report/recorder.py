"""What a report needs of a run, taken while it runs: every value is drawn and packed at once, and then let go.

Keeping the values until the end was rejected: a run of a large photograph frees most of them on the way, and a report
must not need more memory than the run. What the run never touched, since a memoized value stood below it, is looked up
by its key when the run is over. What is in no tier has no picture; `graphface.report.untouched` says why.
"""

from __future__ import annotations

import sys
import threading
import time
import weakref
from collections import deque
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from graphface.cache.memory import MISSING
from graphface.errors import NodeError, RunFailed
from graphface.evaluate.observe import Observer
from graphface.evaluate.reason import Reason
from graphface.graph.request import Request
from graphface.graph.structure import Ref, Step
from graphface.pictures import draw
from graphface.record import Record, State
from graphface.report.above import above
from graphface.report.array_figures import Figures, figures
from graphface.report.blobs import Blobs, Sheet
from graphface.report.picture_size import DEFAULT
from graphface.report.trace import Trace
from graphface.report.untouched import untouched
from graphface.values.frozen import arrays_in, describe
from graphface.values.picture import View

Find = Callable[[bytes, Step | None], tuple[Any, State]]
"""From a key to its value and the tier that had it, or `MISSING`: `Evaluator.find`."""


HAD = frozenset(("ran", "memory", "disk"))
"""The states in which a run had a node's value."""


@dataclass
class Seen:
    """One node or input of the graph, as the report shows it.

    Attributes:
        record: what became of it; None where the run did not touch it. reason: why it has that state, in words.
        sheets: its picture, and those of the fields that other nodes take. arrays: figures of every array in its value.
        start: seconds after the run began; None where it was not evaluated or not followed.
    """

    slot: int
    record: Record | None = None
    reason: str = ""
    sheets: list[Sheet] = field(default_factory=list)
    arrays: list[tuple[str, Figures]] = field(default_factory=list)
    start: float | None = None
    thread: str = ""


class Recorder(Observer):
    """Follows one run for a report.

    Args:
        find: where values are looked up that the run did not touch.
        size: pixels of a picture's longer side.

    Attributes:
        trace: the same run as `--trace` tells it. seen: every slot of the graph, there when the run is over.
        errors: the failures by node. stopped_by: what ended the run before it was done, if anything did.
        seconds: of the run, `drawing` of them for this report.
    """

    def __init__(self, find: Find, size: int = DEFAULT) -> None:
        self.size = size
        self.trace = Trace()
        self.blobs = Blobs()
        self.seen: list[Seen] = []
        self.request: Request | None = None
        self.errors: dict[str, NodeError] = {}
        self.stopped_by: BaseException | None = None
        self.seconds = 0.0
        self.drawing = 0.0
        self._find = find
        self._slots: dict[str, int] = {}
        self._fields: dict[int, set[tuple[str, ...]]] = {}
        self._began = 0.0
        self._started: dict[str, float] = {}
        self._alive: dict[int, weakref.ref[Any]] = {}
        self._recent: deque[Any] = deque(maxlen=4)
        self._measured: dict[int, tuple[weakref.ref[Any], Figures | None]] = {}

    def run_started(self, request: Request) -> None:
        self.request = request
        self.trace.run_started(request)
        graph = request.graph
        self.seen = [Seen(slot) for slot in range(len(graph.names))]
        self._slots = {name: slot for slot, name in enumerate(graph.names)}
        self._fields = fields_taken(request)
        self._began = time.perf_counter()

    def node_started(self, name: str, step: Step | None) -> None:
        self._started[name] = time.perf_counter() - self._began
        self.trace.threads[name] = threading.current_thread().name

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        if record.state == "declined" or self.request is None:
            return
        began = time.perf_counter()
        slot = self._slots[record.name]
        entry = self.seen[slot]
        entry.record, entry.reason = record, record.reason
        if slot in self.request.pinned:
            entry.reason = str(Reason("pinned", new=self.request.pinned[slot].origin))
        entry.start, entry.thread = self._started.get(record.name), self.trace.threads.get(record.name, "")
        if record.state in HAD and value is not MISSING:
            self._take(entry, value)
        elif record.state in HAD:
            entry.reason = "its value is not kept any more"
        self.drawing += time.perf_counter() - began

    def run_finished(self, records: Sequence[Record]) -> None:
        if self.request is None:
            return
        self.seconds = time.perf_counter() - self._began
        self.trace.run_finished(records)
        began = time.perf_counter()
        states = {record.key for record in records if record.state in HAD}
        if any(self.request.key(ref.slot) not in states for ref in self.request.targets.values()):
            self.stopped(sys.exception())
        self._fill(records)
        self.drawing += time.perf_counter() - began

    def stopped(self, error: BaseException | None) -> None:
        """Take in why a run ended early: failures of nodes, an input that cannot be read, Ctrl-C."""
        if isinstance(error, RunFailed):
            self.errors = {failure.node: failure for failure in error.failures}
            self.stopped_by = None
        elif error is not None:
            self.stopped_by = error

    def began(self, name: str) -> bool:
        """Whether a node was started, finished or not."""
        return name in self._started

    def _fill(self, records: Sequence[Record]) -> None:
        """What the run did not touch: its value by key where a tier has it, and the reason."""
        assert self.request is not None
        by_key = {entry.record.key: entry for entry in self.seen if entry.record is not None}
        reasons = untouched(self.request, records)
        for entry in self.seen:
            if entry.record is not None:
                continue
            twin = by_key.get(self.request.key(entry.slot))
            entry.reason = str(reasons.get(entry.slot, ""))
            if twin is not None:
                entry.sheets, entry.arrays = twin.sheets, twin.arrays
                entry.reason = entry.reason if twin.sheets else twin.reason
                continue
            value = self.value_of(entry.slot)
            if value is not MISSING and value is not None:
                self._take(entry, value)

    def _take(self, entry: Seen, value: Any) -> None:
        """Draw and measure a value; afterwards nothing of it is held."""
        assert self.request is not None
        graph, slot = self.request.graph, entry.slot
        if value is None:  # in words: a picture of nothing takes the place of what there is to see
            entry.reason = "nothing was given" if self.request.step(slot) is None else "its value is None"
            self.trace.summaries[graph.names[slot]] = "None"
            return
        self._remember(slot, value)
        entry.arrays = [(path, found) for path, array in arrays_in(value) if (found := self._figures(array))]
        if entry.record is not None and entry.record.state != "ran":
            entry.record.bytes = sum(array.nbytes for _, array in arrays_in(value))
        self.trace.summaries[graph.names[slot]] = describe(value, self._range)
        view = View(self.size, above(self.request, slot, self.value_of))
        for fields, part in _parts(value, self._fields.get(slot, ())):
            declared = graph.type_of(Ref(slot, fields))
            picture = draw(part, declared, graph.registry, view)
            entry.sheets.append(self.blobs.sheet(".".join(fields), str(declared), picture))

    def _figures(self, array: np.ndarray) -> Figures | None:
        """Of each array once: many nodes pass on what they were given."""
        known = self._measured.get(id(array))
        if known is not None and known[0]() is array:
            return known[1]
        found = figures(array)
        self._measured[id(array)] = weakref.ref(array), found
        return found

    def _range(self, array: np.ndarray) -> tuple[float, float]:
        found = self._figures(array)
        return (found.low, found.high) if found is not None and found.counted else (np.nan, np.nan)

    def value_of(self, slot: int) -> Any:
        """The value of a slot while the run, a tier or a graph input has it; else `MISSING`."""
        assert self.request is not None
        held = self._alive.get(slot)
        value = held() if held is not None else None
        if value is not None:
            return value
        step = self.request.step(slot)
        if step is None:
            value = self._input(slot)
        else:
            value, _ = self._find(self.request.key(slot), step)
        if value is not MISSING:
            self._remember(slot, value)
            self._recent.append(value)
        return value

    def _input(self, slot: int) -> Any:
        assert self.request is not None
        bound = self.request.given(slot)
        try:
            return bound.value if bound is not None else MISSING
        except Exception:  # said by the run where it needs the input
            return MISSING

    def _remember(self, slot: int, value: Any) -> None:
        try:
            self._alive[slot] = weakref.ref(value)
        except TypeError:  # a number: small, and nobody is drawn on one
            return


def recorded(
    request: Request, records: Sequence[Record], outputs: Mapping[str, Any], find: Find, size: int = DEFAULT
) -> Recorder:
    """What a recorder would have taken from a run that is over, as far as values are still kept.

    Args:
        outputs: the values of the request's targets.
    """
    held = {ref.slot: outputs[name] for name, ref in request.targets.items() if name in outputs and not ref.fields}
    by_key = {request.key(slot): value for slot, value in held.items()}

    def find_held(key: bytes, step: Step | None) -> tuple[Any, State]:
        return (by_key[key], "ran") if key in by_key else find(key, step)

    recorder = Recorder(find_held, size)
    recorder.run_started(request)
    slots = {name: slot for slot, name in enumerate(request.graph.names)}
    for record in records:
        value = recorder.value_of(slots[record.name]) if record.name in slots and record.state in HAD else MISSING
        recorder.node_finished(replace(record), None, value)
    recorder.run_finished(records)
    recorder.seconds = 0.0
    return recorder


def fields_taken(request: Request) -> dict[int, set[tuple[str, ...]]]:
    """By slot, the fields of its value that nodes of the graph or targets take: the ports that are in use."""
    taken: dict[int, set[tuple[str, ...]]] = {}
    refs = [ref for step in request.graph.steps for argument in step.arguments for ref in argument.refs]
    for ref in (*refs, *request.targets.values(), *request.graph.outputs.values()):
        if ref.fields:
            taken.setdefault(ref.slot, set()).add(ref.fields)
    return taken


def _parts(value: Any, taken: Collection[tuple[str, ...]]) -> Iterator[tuple[tuple[str, ...], Any]]:
    """A value and those of its fields that are taken and there."""
    yield (), value
    for fields in sorted(taken):
        part = value
        for name in fields:
            part = getattr(part, name, None)
        if part is not None:
            yield fields, part
