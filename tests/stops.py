"""A graph to stop in, and a run of it with breakpoints."""

from typing import Any

from graphface import Breakpoint, Evaluator, Graph, MemoryTier

TEXT = """graphface: 1
inputs: {x: {type: float, default: 1}}
nodes:
  a: {use: toy.add, in: {a: x}, with: {plus: 1, label: a}}
  b: {use: toy.add, in: {a: a}, with: {plus: 2, label: b}}
  c: {use: toy.add, in: {a: b, b: a}, with: {label: c}}
  t: {use: toy.total, in: {values: [a, b]}}
  g: {use: toy.grid}
  p: {use: toy.pair, in: {grid: g}}
  m: {use: toy.mean, in: {grid: p.low}}
  bad: {use: toy.fail, in: {a: a}}
outputs: {c: c}
"""


def stops(graph: Graph, *breakpoints: Breakpoint, outputs: list[str] | None = None, threads: int = 1) -> Any:
    evaluator = Evaluator(memory=MemoryTier(), observers=breakpoints, threads=threads)
    return graph.run(outputs, evaluator=evaluator)
