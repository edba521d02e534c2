"""A small ablation of numbers."""

import pytest

from graphface import Registry
from graphface.ablation import ablate
from graphface.ablation.running import Ablation

GRAPH = """
graphface: 1
name: sum
inputs: {x: float}
nodes:
  start: {use: toy.add, in: {a: x}, with: {plus: 1.0, label: start}}
  middle: {use: toy.add, in: {a: start}, with: {label: middle}}
  last: {use: toy.add, in: {a: middle, b: x}, with: {label: last}}
outputs: {y: last}
"""


@pytest.fixture
def numbers(registry: Registry) -> Ablation:
    """One case under `toy.add` (5) and `toy.subtract` (1)."""
    return ablate(GRAPH, ["last=add,subtract"], [{"x": 2.0}], loading={"registry": registry})
