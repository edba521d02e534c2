"""Small graphs of toy operators that several tests read, and how one is refused."""

from collections.abc import Callable

import pytest

from graphface import DocumentError, Graph
from graphface.errors import Problem

SUMS = """graphface: 1
name: sums
inputs: {x: {type: float, default: 2}, g: Grid}
nodes:
  a: {use: toy.add, in: {a: x}, with: {plus: 1}}
  p: {use: toy.pair, in: {grid: g}}
  m: {use: toy.mean, in: {grid: p.low}}
outputs: {y: a, low: p.low}
"""

ADD = "nodes:\n  n: {use: toy.number}\n  x: {use: toy.add, in: {a: n}, with: {plus: 1}}\noutputs: {y: x}\n"
"""Without the first line, which `write` of tests/document adds."""

CHAIN = """
graphface: 1
name: sum
inputs: {x: float}
nodes:
  start: {use: toy.add, in: {a: x}, with: {plus: 1.0, label: start}}
  middle: {use: toy.add, in: {a: start}, with: {label: middle}}
  last: {use: toy.add, in: {a: middle, b: x}, with: {label: last}}
outputs: {y: last}
"""


def refused(opened: Callable[..., Graph], path: object, **choices: object) -> list[Problem]:
    """The problems of a graph that is not loaded."""
    with pytest.raises(DocumentError) as caught:
        opened(path, **choices)
    return caught.value.problems
