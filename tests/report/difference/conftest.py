"""Toy graphs compared, and their page in a browser."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from toys import toy_registry

from graphface import Evaluator, MemoryTier, load
from graphface.facade import Graph
from graphface.report.difference.compare import Comparison

GRAPH = """
graphface: 1
name: toys
inputs: {x: {type: float, default: 2}}
nodes:
  g: {use: toy.grid, with: {size: 8}}
  s: {use: toy.scale, in: {grid: g}, with: {by: 3}}
  t: {use: toy.scale, in: {grid: s}, with: {by: 2}}
  m: {use: toy.mean, in: {grid: t}}
  n: {use: toy.add, in: {a: m, b: x}}
outputs: {y: n}
"""


@pytest.fixture
def graph() -> Callable[..., Graph]:
    """The graph of toys, with parameters set or nodes added."""

    def made(text: str = GRAPH, **choices: Any) -> Graph:
        return load(text, registry=toy_registry(), **choices)

    return made


@pytest.fixture
def compared(graph: Callable[..., Graph]) -> Callable[..., Comparison]:
    """The graph as it is, against another text or other parameters."""

    def made(other: str = GRAPH, one: str = GRAPH, inputs: Any = (), **choices: Any) -> Comparison:
        first, second = graph(one), graph(other, **choices)
        given = dict(inputs)
        evaluator = Evaluator(memory=MemoryTier())
        return Comparison(first.request({}), second.request(given), evaluator)

    return made
