"""A debugged run takes stored values of what is not debugged, and runs what is."""

from pathlib import Path

import pytest

from graphface import Evaluator, MemoryTier, Registry, load
from graphface.cache.disk import DiskTier
from graphface.debug.evaluator import DebugEvaluator

TEXT = """graphface: 1
nodes:
  a: {use: toy.number, with: {label: a}}
  b: {use: toy.add, in: {a: a}, with: {label: b}}
  c: {use: toy.add, in: {a: b}, with: {label: c}}
  beside: {use: toy.add, in: {a: a}, with: {plus: 5, label: beside}}
outputs: {c: c, beside: beside}
"""


@pytest.mark.parametrize(("at", "runs"), [("a", ["a", "b", "beside", "c"]), ("b", ["b", "c"]), ("c", ["c"])])
def test_runs_below(registry: Registry, ran: list[str], tmp_path: Path, at: str, runs: list[str]) -> None:
    """The node and all below it run though they are on disk, once; a second run has them in memory."""
    graph, disk = load(TEXT, registry=registry), DiskTier(tmp_path / "c", 1 << 20)
    expected = dict(Evaluator(disk=disk).run(graph.request()))
    ran.clear()
    evaluator = DebugEvaluator(graph, [graph.node(at)], memory=MemoryTier(), disk=disk, guard="error")
    assert dict(evaluator.run(graph.request())) == expected
    assert sorted(ran) == runs
    ran.clear()
    assert dict(evaluator.run(graph.request())) == expected
    assert ran == []
