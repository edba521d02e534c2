"""The nearest value of a type among those that a value was made from."""

from typing import Any

import numpy as np
from toys import FineGrid, Grid, Pair, toy_registry

from graphface import load
from graphface.cache.memory import MISSING
from graphface.report.above import above
from graphface.values.port_types import array_of

TEXT = """\
graphface: 1
inputs: {x: float}
nodes:
  far: {use: toy.grid}
  pair: {use: toy.pair, in: {grid: far}}
  high: {use: toy.scale, in: {grid: pair.low}}
  mean: {use: toy.mean, in: {grid: high}}
  sum: {use: toy.add, in: {a: mean, b: x}}
"""
VALUES: dict[str, Any] = {
    "x": 1.0,
    "far": np.ones((4, 4)),
    "pair": Pair(np.ones((4, 4)), np.full((4, 4), 2.0)),
    "high": np.full((4, 4), 4.0),
    "mean": 4.0,
}
GRID, FINE = array_of(Grid), array_of(FineGrid)


def nearest(node: str, kind: Any, values: dict[str, Any] = VALUES) -> Any:
    graph = load(TEXT, registry=toy_registry())
    request = graph.request({"x": 1.0}, [node])
    slots = {name: slot for slot, name in enumerate(graph.names)}
    return above(request, slots[node], lambda slot: values.get(graph.names[slot], MISSING))(kind)


def test_nearest() -> None:
    """What is plugged in comes before what that was made from; a value is not above itself."""
    assert nearest("mean", GRID) is VALUES["high"]
    assert nearest("high", GRID) is VALUES["pair"].low
    assert nearest("far", GRID) is None


def test_order_of_ports() -> None:
    """At the same distance the port that is declared first wins; graph inputs count."""
    assert nearest("sum", float) == 4.0
    assert nearest("sum", float, {"x": 1.0}) == 1.0


def test_record() -> None:
    """A record is found as itself, and by its fields."""
    assert nearest("mean", Pair) is VALUES["pair"]
    assert nearest("mean", GRID, {"pair": VALUES["pair"]}) is VALUES["pair"].low


def test_unknown() -> None:
    """A value that is not known is passed over; a type that nothing above has gives None."""
    assert nearest("mean", GRID, {"far": VALUES["far"]}) is VALUES["far"]
    assert nearest("mean", GRID, {}) is None
    assert nearest("mean", FINE) is None


def test_looks_up_what_may_fit_only() -> None:
    """A value whose declared type cannot hold what is asked for is not fetched."""
    graph = load(TEXT, registry=toy_registry())
    asked: list[str] = []
    slot = graph.names.index("sum")
    find = above(graph.request({"x": 1.0}, ["sum"]), slot, lambda s: asked.append(graph.names[s]))
    assert find(Pair) is None
    assert asked == ["pair"]
