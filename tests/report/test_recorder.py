"""A recorder takes from a run what a report shows, and keeps no value."""

import gc
import weakref
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from toys import toy_registry

from graphface import Evaluator, MemoryTier, RunFailed, load
from graphface.cache.disk import DiskTier
from graphface.report.recorder import Recorder, Seen, recorded

TEXT = """\
graphface: 1
inputs: {x: {type: float, default: 1}}
nodes:
  grid: {use: toy.grid, with: {size: 40}}
  pair: {use: toy.pair, in: {grid: grid}}
  twice: {use: toy.scale, in: {grid: pair.low}}
  mean: {use: toy.mean, in: {grid: twice}}
  warned: {use: toy.fall_back, in: {a: x}}
  bad: {use: toy.fail, in: {a: warned}}
  cut: {use: toy.interrupt, in: {a: warned}}
"""


def seen_in(outputs: list[str], evaluator: Evaluator | None = None, size: int = 16) -> tuple[Recorder, dict[str, Seen]]:
    """What a recorder saw of a run, failed or not."""
    graph = load(TEXT, registry=toy_registry())
    evaluator = evaluator or Evaluator()
    recorder = Recorder(evaluator.find, size)
    try:
        evaluator.run(graph.request({}, outputs), [recorder])
    except (RunFailed, KeyboardInterrupt) as error:
        recorder.stopped(error)
    return recorder, {graph.names[entry.slot]: entry for entry in recorder.seen}


def test_sheets() -> None:
    """A node has a picture of its value, and of each field that is plugged in somewhere."""
    _, seen = seen_in(["mean"])
    assert [sheet.label for sheet in seen["grid"].sheets] == [""]
    assert [sheet.label for sheet in seen["pair"].sheets] == ["", "low"]
    assert seen["grid"].sheets[0].full == (40, 40)
    assert seen["grid"].sheets[0].width == 16
    assert [path for path, _ in seen["pair"].arrays] == ["low", "high"]


def test_times() -> None:
    """What ran has its start and thread; starts follow the wires."""
    recorder, seen = seen_in(["mean"])
    starts = [seen[name].start for name in ("grid", "pair", "twice", "mean")]
    assert None not in starts
    assert starts == sorted(starts)
    assert seen["mean"].thread
    assert recorder.seconds > 0


def test_keeps_no_value() -> None:
    """When the run is over nothing of the recorder holds an array."""
    held: list[weakref.ref[Any]] = []

    class Spy(Recorder):
        def node_finished(self, record: Any, step: Any, value: Any) -> None:
            super().node_finished(record, step, value)
            if isinstance(value, np.ndarray):
                held.append(weakref.ref(value))

    graph = load(TEXT, registry=toy_registry())
    evaluator = Evaluator()
    spy = Spy(evaluator.find, 16)
    evaluator.run(graph.request({}, ["mean"]), [spy])
    gc.collect()
    assert len(held) == 2
    assert all(ref() is None for ref in held)


@pytest.mark.parametrize("tier", ["memory", "disk"])
def test_memoized_away(tier: str, tmp_path: Path) -> None:
    """Nodes above a memoized value have their pictures all the same, looked up by key."""
    disk = DiskTier(tmp_path / "cache", 1 << 30) if tier == "disk" else None
    evaluator = Evaluator(memory=MemoryTier() if tier == "memory" else None, disk=disk)
    seen_in(["twice"], evaluator)
    _, seen = seen_in(["twice"], evaluator)
    assert seen["twice"].record is not None
    assert seen["twice"].record.state == tier
    assert seen["grid"].record is None
    assert seen["grid"].sheets
    assert seen["grid"].reason == "only twice needs it, and that is memoized"


def test_gone() -> None:
    """What is in no tier has no picture, and a reason."""
    _, seen = seen_in(["grid"])
    assert not seen["twice"].sheets
    assert seen["twice"].reason == "not needed for grid"


def test_failed() -> None:
    """A failed run is recorded up to the failure; its inputs are there."""
    recorder, seen = seen_in(["bad"])
    assert seen["bad"].record is not None
    assert seen["bad"].record.state == "failed"
    assert seen["warned"].sheets
    assert "bad" in recorder.errors
    assert recorder.stopped_by is None


def test_interrupted() -> None:
    """A run that was interrupted knows by what, and which node was at work."""
    recorder, seen = seen_in(["cut"])
    assert isinstance(recorder.stopped_by, KeyboardInterrupt)
    assert seen["cut"].record is None
    assert recorder.began("cut")
    assert not recorder.began("bad")


def test_afterwards() -> None:
    """A run that is over is recorded from its records and what is still kept."""
    graph = load(TEXT, registry=toy_registry())
    for evaluator, kept in ((Evaluator(memory=MemoryTier()), True), (Evaluator(), False)):
        asked = graph.request({}, ["twice"])
        result = evaluator.run(asked)
        recorder = recorded(asked, result.records, result.outputs, evaluator.find, 16)
        seen = {graph.names[entry.slot]: entry for entry in recorder.seen}
        assert seen["twice"].sheets
        assert bool(seen["grid"].sheets) == kept
        assert kept or seen["grid"].reason == "its value is not kept any more"
