"""A cache and a history that several requests share, and a graph to ask."""

from pathlib import Path
from typing import Any

from toys import toy_registry

from graphface import Evaluator, Graph, MemoryTier, Registry, RunFailed, load
from graphface.cache.disk import DiskTier
from graphface.report.explain import Explained, Sizes, explain, with_results
from graphface.report.history import History, Remember

NODES = """\
graphface: 1
name: lab
inputs: {x: float}
nodes:
  left: {use: toy.add, in: {a: x}, with: {plus: 1}}
  right: {use: toy.add, in: {a: x}, with: {plus: 2}}
  join: {use: toy.add, in: {a: left, b: right}}
  grid: {use: toy.grid}
  pair: {use: toy.pair, in: {grid: grid}}
  mean: {use: toy.mean, in: {grid: pair.low}}
outputs: {join: join, mean: mean}
"""


class Lab:
    """A cache and a history that several requests share."""

    def __init__(self, folder: Path, *, disk: bool = True, budget: int = 1 << 26) -> None:
        self.folder = folder
        self.said: list[str] = []
        self.memory = None if disk else MemoryTier(budget)
        self.disk = DiskTier(folder, budget, self.said.append) if disk else None
        self.history = History.beside(folder if disk else None)

    def evaluator(self, *observers: Any) -> Evaluator:
        return Evaluator(memory=self.memory, disk=self.disk, observers=observers)

    def before(self, graph: Graph, outputs: list[str] | None = None, **inputs: Any) -> dict[str, Explained]:
        """What is said without running anything."""
        asked = graph.request(inputs, outputs)
        return {entry.name: entry for entry in explain(asked, self.evaluator(), self.history)}

    def run(self, graph: Graph, outputs: list[str] | None = None, **inputs: Any) -> dict[str, Explained]:
        """What is said of a run."""
        asked = graph.request(inputs, outputs)
        evaluator = self.evaluator(Sizes(), Remember(self.history, self.disk))
        explained = explain(asked, evaluator, self.history)
        try:
            records = evaluator.run(asked).records
        except RunFailed as failure:
            records = failure.records
        return {entry.name: entry for entry in with_results(explained, records, self.said)}


def graph_of(text: str = NODES, registry: Registry | None = None, **choices: Any) -> Graph:
    return load(text, registry=registry or toy_registry(), **choices)
