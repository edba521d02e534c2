"""The trace of a run: what happened at every node, as data that can be written to `run.json`.

An observer like any other. The summaries (shape, dtype, range) read every value once and the memory peak slows
allocation, so both are there only when a trace is asked for.
"""

from __future__ import annotations

import json
import math
import platform
import sys
import threading
import tracemalloc
from collections.abc import Iterable, Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

from graphface.evaluate.observe import Observer
from graphface.graph.inputs import Bound
from graphface.graph.request import Request
from graphface.graph.structure import Step
from graphface.record import Record
from graphface.values.frozen import describe
from graphface.values.parts import NUMBERED, rule_of
from graphface.values.writing import beside

_LIBRARIES = ("graphface", "numpy", "opencv-contrib-python-headless", "scipy", "scikit-image", "pydantic", "xxhash")


class Trace(Observer):
    """Collects one run.

    Args:
        peaks: measure each node's peak of allocated bytes above what was there when it began (Python and NumPy;
            OpenCV's own memory is not seen). Only meaningful with one thread; allocation becomes about twice as slow.
    """

    def __init__(self, *, peaks: bool = False) -> None:
        self.records: list[Record] = []
        self.summaries: dict[str, str] = {}
        self.parameters: dict[str, Mapping[str, Any]] = {}
        self.threads: dict[str, str] = {}
        self.peaks: dict[str, int] = {}
        self._request: Request | None = None
        self._measure = peaks
        self._tracing = False
        self._before: dict[str, int] = {}

    def run_started(self, request: Request) -> None:
        self._request = request
        for held in (self.summaries, self.threads, self.peaks):
            held.clear()
        self.parameters = {step.name: step.parameters for step in request.steps()}
        if self._measure and not tracemalloc.is_tracing():
            tracemalloc.start()
            self._tracing = True

    def node_started(self, name: str, step: Step | None) -> None:
        self.threads[name] = threading.current_thread().name
        if self._measure:
            tracemalloc.reset_peak()
            self._before[name] = tracemalloc.get_traced_memory()[0]

    def node_finished(self, record: Record, step: Step | None, value: Any) -> None:
        if record.name in self._before:
            self.peaks[record.name] = max(0, tracemalloc.get_traced_memory()[1] - self._before.pop(record.name))
        if record.state in ("ran", "memory", "disk"):
            self.summaries[record.name] = describe(value)

    def run_finished(self, records: Sequence[Record]) -> None:
        self.records = list(records)
        if self._tracing:
            tracemalloc.stop()
            self._tracing = False

    def as_json(self) -> dict[str, Any]:
        """Versions, graph, what was given and every node of the run; a parameter that JSON does not know is its `repr`.

        Raises:
            RuntimeError: no run was followed.
        """
        if self._request is None:
            raise RuntimeError("this trace followed no run")
        graph = self._request.graph
        return {
            "versions": versions(),
            "platform": f"{sys.platform} {platform.machine()}",
            "graph": graph.name,
            "document": graph.effective(origins=False),
            "inputs": _origins(self._request.bound),
            "pinned": _origins(self._request.pinned.values()),
            "nodes": [self._node(record) for record in self.records],
        }

    def write_to(self, path: Path) -> None:
        """Write `as_json` to a file, whole or not at all.

        Raises:
            UnwritableFile: the folder cannot be written to.
        """
        with beside(path) as temporary:
            temporary.write_text(json.dumps(self.as_json(), indent=1), encoding="utf-8")

    def _node(self, record: Record) -> dict[str, Any]:
        return {
            "name": record.name,
            "operator": record.operator,
            "key": record.key.hex(),
            "state": record.state,
            "wall_ms": round(record.seconds * 1e3, 4),
            "cpu_ms": round(record.cpu * 1e3, 4),
            "bytes": record.bytes,
            "peak_bytes": self.peaks.get(record.name),
            "thread": self.threads.get(record.name),
            "parameters": jsonable(self.parameters.get(record.name, {})),
            "value": self.summaries.get(record.name),
            "reason": record.reason,
            "warnings": list(record.warnings),
        }


def _origins(given: Iterable[Bound | None]) -> dict[str, Any]:
    return {bound.name: _origin(bound) for bound in given if bound is not None}


def _origin(bound: Bound) -> dict[str, Any]:
    """Where an input came from; of a number or text also what it was, since no file tells."""
    origin: dict[str, Any] = {"origin": bound.origin, "digest": bound.digest.hex()}
    return origin | {"value": jsonable(bound.number)} if bound.is_number else origin


def jsonable(value: Any) -> Any:
    """A parameter as strict JSON has it; what JSON does not know (infinity, a path) is its `repr`."""
    rule = rule_of(type(value))
    if rule is NUMBERED:
        return [jsonable(item) for item in value]
    if rule is not None:
        return {str(label): jsonable(part) for label, part in rule.items(value)}
    known = type(value) in (str, int, bool, type(None)) or (type(value) is float and math.isfinite(value))
    return value if known else repr(value)


def versions() -> dict[str, str]:
    """Of Python and of the packages that decide what operators give, where installed."""
    found = {"python": platform.python_version()}
    for name in _LIBRARIES:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return found
