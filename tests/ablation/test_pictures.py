"""What an ablation draws while it runs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphface import Evaluator, MemoryTier, Registry
from graphface.ablation import ablate
from graphface.ablation.pictures import Pictures

GRAPH = """
graphface: 1
name: grids
inputs: {start: Grid}
nodes:
  same: {use: toy.scale, in: {grid: start}}
  pair: {use: toy.pair, in: {grid: same}}
  s: {use: toy.scale, in: {grid: pair.low}, with: {by: 2}}
  t: {use: toy.scale, in: {grid: s}}
outputs: {y: t}
"""


@pytest.fixture
def drawn(registry: Registry) -> Any:
    def made(*swaps: str, truths: Any = (), nodes: Any = ()) -> Pictures:
        evaluator = Evaluator(memory=MemoryTier())
        pictures = Pictures(evaluator, "y", truths=truths, nodes=nodes, size=32)
        case = {"start": np.arange(16.0).reshape(4, 4)}
        loading = {"registry": registry}
        ablate(GRAPH, swaps, [case], truths=truths, evaluator=evaluator, loading=loading, watcher=pictures)
        return pictures

    return made


def test_nodes_that_differ(drawn: Any) -> None:
    """The output first, then what is not the same in every variant, in order; for each a picture of each variant."""
    shown = drawn("s.by=1,2,3").cases[0]
    assert shown.places == ["y", "s"]
    assert set(shown.layers) == {(place, v) for place in ("y", "s") for v in (0, 1, 2)}
    assert [shown.layers["y", v]["label"] for v in range(3)] == ["s.by=1", "s.by=2", "s.by=3"]


def test_fields_that_are_taken(drawn: Any) -> None:
    """Of a record the parts that other nodes take."""
    assert drawn("same.by=1,2").cases[0].places == ["y", "same", "pair.low", "s"]


def test_original_and_truth(drawn: Any) -> None:
    """The input of the output's type, and the true output."""
    shown = drawn("s.by=1,2", truths=[np.ones((4, 4))]).cases[0]
    assert (shown.original["label"], shown.truth["label"]) == ("original", "truth")
    assert drawn("s.by=1,2").cases[0].truth is None


def test_values_under_the_pixels(drawn: Any) -> None:
    """Outputs and nodes that were asked for have them, others are pictures only."""
    shown = drawn("s.by=1,2", nodes=["same"]).cases[0]
    assert shown.places == ["y", "s", "same"]
    assert ["data" in shown.layers[place, 0] for place in shown.places] == [True, False, True]


def test_equal_pictures_are_stored_once(drawn: Any) -> None:
    """A node that is the same in every variant takes the room of one."""
    shown = drawn("s.by=1,2", nodes=["same"]).cases[0]
    assert shown.layers["same", 0]["image"] == shown.layers["same", 1]["image"]


def test_failures(drawn: Any) -> None:
    """A variant that failed says why in place of its picture; what came before the failure is there."""
    shown = drawn("t=scale,write").cases[0]
    assert "read-only" in shown.layers["y", 1]["message"]
    assert "image" in shown.layers["y", 0]


def test_unknown_node(drawn: Any) -> None:
    """A name that is none says so in place of the picture."""
    assert "no such node" in drawn("s.by=1,2", nodes=["nowhere"]).cases[0].layers["nowhere", 0]["message"]
