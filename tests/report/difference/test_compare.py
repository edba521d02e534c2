"""Two requests compared: which nodes differ, what was changed, and that nothing runs twice."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphface import Evaluator, MemoryTier
from graphface.cache.disk import DiskTier
from graphface.facade import Graph
from graphface.report.difference import compare
from graphface.report.difference.compare import Comparison, merged
from graphface.report.difference.tolerance import Tolerance

Compared = Callable[..., Comparison]

HEAD = "graphface: 1\nname: toys\nnodes:\n"


class TestValues:
    def test_equal(self, compared: Compared) -> None:
        """The same graph: all keys are equal, nothing is looked at."""
        found = compared().differences()
        assert not found
        assert (found.compared, found.equal, found.first) == (6, 6, None)

    def test_order_and_cause(self, compared: Compared) -> None:
        """The node that was changed comes first, with old and new value; those below inherit from the node above."""
        found = compared(set={"s.by": 4}).differences()
        assert [node.name for node in found] == ["s", "t", "m", "n"]
        assert [str(reason) for reason in found.nodes[0].caused] == ["parameter by changed from 3.0 to 4.0"]
        assert [(node.caused, [r.node for r in node.reasons]) for node in found.nodes[1:3]] == [
            ((), ["s"]),
            ((), ["t"]),
        ]
        assert found.first is found.nodes[0]
        assert found.nodes[0].parts[0].greatest == 1

    def test_nothing_runs_twice(self, compared: Compared, ran: list[str]) -> None:
        """What both sides have in common is computed once."""
        compared(set={"t.by": 5}).differences()
        assert ran.count("grid") == 1
        assert ran.count("scale") == 3  # s once, t twice

    def test_changed_without_effect(self, compared: Compared) -> None:
        """A node that was changed and gives the same is said apart, and nothing below it is listed."""
        found = compared(set={"n.plus": 0.0, "g.fill": 1.0, "s.by": 3.0}).differences()
        assert not found
        same = compared(
            HEAD + "  g: {use: toy.grid}\n  n: {use: toy.mean, in: {grid: g}}\noutputs: {y: n}\n",
            HEAD + "  g: {use: toy.fine}\n  n: {use: toy.mean, in: {grid: g}}\noutputs: {y: n}\n",
        ).differences()
        assert not same
        assert [name for name, _ in same.without_effect] == ["g"]

    def test_inputs(self, compared: Compared) -> None:
        """An input that differs is listed itself; the node that reads it inherits."""
        found = compared(inputs={"x": 5.0}).differences()
        assert [node.name for node in found] == ["x", "n"]
        assert [r.kind for r in found.nodes[0].caused] == ["input"]
        assert (found.nodes[1].caused, found.nodes[1].reasons[0].node) == ((), "x")

    def test_shapes(self, compared: Compared) -> None:
        """Other sizes are said, not measured."""
        found = compared(set={"g.size": 4}).differences()
        assert found.nodes[0].parts[0].words == "shape [8, 8] became [4, 4]"

    def test_tolerance(self, compared: Compared) -> None:
        """What differs by no more than the tolerance is told apart; at the tolerance itself it still counts as none."""
        comparison = compared(set={"n.plus": 0.08})
        part = comparison.differences().nodes[0].parts[0]
        assert comparison.differences(Tolerance(part.relative)).nodes == []
        assert [n.name for n in comparison.differences(Tolerance(part.relative)).below] == ["n"]
        assert len(comparison.differences(Tolerance(np.nextafter(part.relative, 0)))) == 1
        assert len(comparison.differences(Tolerance(absolute=part.greatest))) == 0
        assert len(comparison.differences(Tolerance(absolute=np.nextafter(part.greatest, 0)))) == 1

    def test_wiring(self, compared: Compared) -> None:
        """A port that is plugged in elsewhere is a change of the node."""
        text = (
            HEAD + "  g: {use: toy.grid}\n  s: {use: toy.scale, in: {grid: g}}\n  m: {use: toy.mean, in: {grid: %s}}\n"
        )
        found = compared(text % "g" + "outputs: {y: m, z: s}\n", text % "s" + "outputs: {y: m, z: s}\n").differences()
        assert [str(reason) for node in found for reason in node.caused] == ["port grid is connected to g, was s"]


class TestAbsence:
    def test_nodes_of_one_side(self, compared: Compared) -> None:
        """A node that one side lacks is listed, between those that run before and after it."""
        start = HEAD + "  g: {use: toy.grid}\n"
        one = start + "  n: {use: toy.mean, in: {grid: g}}\noutputs: {y: n}\n"
        two = start + "  s: {use: toy.scale, in: {grid: g}}\n  n: {use: toy.mean, in: {grid: s}}\noutputs: {y: n}\n"
        found = compared(two, one).differences()
        assert [(node.name, node.kind) for node in found] == [("s", "only here"), ("n", "values")]
        assert found.first.name == "n"
        back = compared(one, two).differences()
        assert [(node.name, node.kind) for node in back] == [("s", "only there"), ("n", "values")]
        assert back.nodes[0].words == "B has no such node"

    def test_declined(self, compared: Compared) -> None:
        """A node behind a port that one side declines is said to be, with the reason."""
        nodes = "  a: {use: toy.number}\n  b: {use: toy.number, with: {value: 5}}\n"
        gate = "  p: {use: toy.gate, in: {a: a, extra: b}, with: {open: %s}}\noutputs: {y: p}\n"
        text = HEAD + nodes + gate
        found = compared(text % "false", text % "true").differences()
        assert [(node.name, node.kind) for node in found] == [("b", "only there"), ("p", "values")]
        assert found.nodes[0].words == "not needed in B: p declined it: the gate is shut"

    def test_merged(self) -> None:
        """The order of the second, with the others where they were."""
        assert merged(["a", "x", "b", "z"], ["a", "n", "b"]) == ["a", "n", "x", "b", "z"]
        assert merged(["x"], []) == ["x"]


class TestFailures:
    TEXT = (
        HEAD
        + "  a: {use: toy.number}\n  f: {use: toy.%s, in: {a: a}}\n  n: {use: toy.add, in: {a: f}}\noutputs: {y: n}\n"
    )

    def test_on_one_side(self, compared: Compared) -> None:
        """A node that fails on one side is a difference, with its message; those that waited for it say so."""
        found = compared(self.TEXT % "fail", self.TEXT % "add").differences()
        assert [(node.name, node.kind) for node in found] == [("f", "failed"), ("n", "failed")]
        assert found.nodes[0].words == "B: ValueError: it broke"
        assert found.nodes[1].words == "B: a node above it failed"

    def test_on_both(self, compared: Compared) -> None:
        """A failure that both share is no difference, but is told."""
        found = compared(self.TEXT % "fail", self.TEXT % "fail").differences()
        assert not found
        assert found.failed_alike == [("f", "ValueError: it broke")]

    def test_nan(self, graph: Callable[..., Graph]) -> None:
        """Where the guard lets NaN through, it equals itself; on one side only it is a difference."""
        text = HEAD + "  g: {use: toy.grid}\n  p: {use: toy.poison, in: {grid: g}, with: {row: %d}}\noutputs: {y: p}\n"
        evaluator = Evaluator(memory=MemoryTier(), guard="off")
        found = compare(graph(text % 0).request(), graph(text % 1).request(), evaluator)
        assert [node.parts[0].non_finite for node in found] == [2]


class TestTiers:
    @pytest.mark.parametrize("memory", [None, MemoryTier(0)])
    def test_what_is_not_kept_is_computed_again(self, graph: Callable[..., Graph], memory: Any) -> None:
        """Without a tier, or with one that holds nothing, the answer is the same."""
        found = compare(graph().request(), graph(set={"s.by": 4}).request(), Evaluator(memory=memory))
        assert [node.name for node in found] == ["s", "t", "m", "n"]

    def test_behind_a_memoized_output(self, graph: Callable[..., Graph], tmp_path: Path) -> None:
        """Nodes that a run does not reach, since their output is on disk, are compared all the same."""
        one, other = graph().request(), graph(set={"s.by": 4}).request()
        Evaluator(disk=DiskTier(tmp_path / "cache", 1 << 20)).run(one)
        Evaluator(disk=DiskTier(tmp_path / "cache", 1 << 20)).run(other)
        evaluator = Evaluator(memory=MemoryTier(), disk=DiskTier(tmp_path / "cache", 1 << 20))
        assert [node.name for node in compare(one, other, evaluator)] == ["s", "t", "m", "n"]
