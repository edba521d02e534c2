"""One side of a comparison: which nodes are needed, and their values."""

from __future__ import annotations

from collections.abc import Callable

from toys import Grid

from graphface import Evaluator, MemoryTier
from graphface.facade import Graph
from graphface.report.difference.side import Side
from graphface.values.port_types import array_of

HEAD = "graphface: 1\nname: toys\n"


def test_values(graph: Callable[..., Graph]) -> None:
    """Of nodes and of inputs, by name."""
    side = Side(graph().request({"x": 3.0}), Evaluator(memory=MemoryTier()))
    assert list(side.needed) == ["x", "g", "s", "t", "m", "n"]
    assert (side.value("x"), side.value("n"), str(side.type_of("s"))) == (3.0, 9.0, "Grid")


def test_what_stands_above(graph: Callable[..., Graph]) -> None:
    """A drawing finds the nearest value of a type."""
    side = Side(graph().request(), Evaluator(memory=MemoryTier()))
    assert side.view("m", 64).above(array_of(Grid)) is side.value("t")


def test_declined_by_a_value(graph: Callable[..., Graph]) -> None:
    """A port that a rule declines when it sees a value: what stands behind it is not needed, and why."""
    nodes = "nodes: {a: {use: toy.number, with: {value: -1}}, b: {use: toy.number, with: {value: 7}}, "
    nodes += "c: {use: toy.add, in: {a: b}}, p: {use: toy.positive, in: {a: a, extra: c}}}\noutputs: {y: p}\n"
    evaluator = Evaluator(memory=MemoryTier())
    asked = graph(HEAD + nodes).request()
    for side in (Side(asked, evaluator), Side(asked, evaluator)):  # the second looks everything up
        assert list(side.needed) == ["a", "p"]
        assert set(side.declined.values()) == {"p declined it: a is not positive"}
        assert set(side.declined) == {"b", "c"}


def test_failures(graph: Callable[..., Graph]) -> None:
    """What failed, and what had to wait for it; equal nodes fail alike."""
    nodes = "nodes: {a: {use: toy.number}, f: {use: toy.fail, in: {a: a}}, h: {use: toy.fail, in: {a: a}}, "
    nodes += "n: {use: toy.add, in: {a: f}}}\noutputs: {y: n, z: h}\n"
    side = Side(graph(HEAD + nodes).request(), Evaluator(memory=MemoryTier()))
    assert (side.failures, side.blocked) == (dict.fromkeys(("f", "h"), "ValueError: it broke"), {"n"})


def test_records_of_a_run_that_is_over(graph: Callable[..., Graph], ran: list[str]) -> None:
    """Given those, nothing runs."""
    evaluator, asked = Evaluator(memory=MemoryTier()), graph().request()
    records = evaluator.run(asked).records
    ran.clear()
    assert Side(asked, evaluator, records).value("s").mean() == 3
    assert ran == []
