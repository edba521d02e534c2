"""Observers of values: told while a value is there, with what it was made from."""

from pathlib import Path
from typing import Any

import numpy as np
from toys import toy_registry

from graphface import Evaluator, MemoryTier, load
from graphface.cache.disk import DiskTier
from graphface.report.watching import Watcher

TEXT = """\
graphface: 1
inputs: {x: float}
nodes:
  grid: {use: toy.grid, with: {size: 8}}
  twice: {use: toy.scale, in: {grid: grid}}
  mean: {use: toy.mean, in: {grid: twice}}
  sum: {use: toy.add, in: {a: mean, b: x}}
  gate: {use: toy.gate, in: {a: sum, extra: mean}, with: {open: false}}
"""


class Seen(Watcher):
    def __init__(self, evaluator: Evaluator, **options: Any) -> None:
        super().__init__(evaluator, **options)
        self.seen: dict[str, Any] = {}
        self.arrays_above: dict[str, Any] = {}

    def on_value(self, slot: int, value: Any) -> None:
        assert self.request is not None
        name = self.request.graph.names[slot]
        self.seen[name] = value
        found = self.above(slot)(np.ndarray)
        self.arrays_above[name] = None if found is None else float(found[0, 0])


def watched(evaluator: Evaluator, outputs: list[str], **options: Any) -> Seen:
    seen = Seen(evaluator, **options)
    evaluator.run(load(TEXT, registry=toy_registry()).request({"x": 1.0}, outputs), [seen])
    return seen


def test_every_value() -> None:
    """Inputs and nodes, each once; what was declined is no value."""
    assert watched(Evaluator(), ["gate"]).seen.keys() == {"x", "grid", "twice", "mean", "sum", "gate"}


def test_what_is_above() -> None:
    """What a value was made from is there when it is told, though the run keeps nothing."""
    seen = watched(Evaluator(), ["sum"])
    assert seen.arrays_above["twice"] == 1
    assert seen.arrays_above["mean"] == 2


def test_memoized(tmp_path: Path) -> None:
    """Values that a run finds memoized are told; those above them only where all are asked for."""
    for evaluator in (Evaluator(memory=MemoryTier()), Evaluator(disk=DiskTier(tmp_path, 1 << 20))):
        watched(evaluator, ["mean"])
        assert watched(evaluator, ["mean"]).seen.keys() == {"mean"}
        seen = watched(evaluator, ["mean"], every=True)
        assert seen.seen.keys() == {"grid", "twice", "mean"}
        assert seen.arrays_above["mean"] == 2
