"""A graph of 100,000 nodes loads, plans and runs, in time that grows linearly.

`GRAPHFACE_LARGE=1 pytest tests/stability/test_large.py` runs the whole size; otherwise a tenth of it.
"""

from __future__ import annotations

import os
import tracemalloc

import pytest

from graphface import Evaluator, Graph, MemoryTier, Registry, load
from graphface.evaluate.plan import plan
from graphface.report.history import identities

NODES = 100_000 if os.environ.get("GRAPHFACE_LARGE") else 10_000
WIDTH = 100


def layered(nodes: int) -> str:
    """A layered graph of unlike nodes, each taking two of the layer above; all sinks are outputs."""
    lines = ["graphface: 1", "name: large", "inputs: {x: float}", "nodes:"]
    for i in range(nodes):
        layer, column = divmod(i, WIDTH)
        a, b = (f"n{i - WIDTH}", f"n{(layer - 1) * WIDTH + (column + 1) % WIDTH}") if layer else ("x", "x")
        lines.append(f"  n{i}: {{use: toy.subtract, in: {{a: {a}, b: {b}}}, with: {{times: {i}e-6}}}}")
    lines.append("outputs:")
    lines += [f"  o{i}: n{nodes - WIDTH + i}" for i in range(WIDTH)]
    return "\n".join(lines) + "\n"


def truth(nodes: int) -> list[float]:
    """The sinks of `layered` at x = 1."""
    values = [1.0] * WIDTH
    for start in range(0, nodes, WIDTH):
        values = [values[c] - float(f"{start + c}e-6") * values[(c + 1) % WIDTH] for c in range(WIDTH)]
    return values


def chain(nodes: int) -> str:
    """One long chain."""
    lines = ["graphface: 1", "inputs: {x: float}", "nodes:", "  n0: {use: toy.add, in: {a: x}}"]
    lines += [f"  n{i}: {{use: toy.add, in: {{a: n{i - 1}}}, with: {{plus: 1}}}}" for i in range(1, nodes)]
    return "\n".join([*lines, f"outputs: {{end: n{nodes - 1}}}"]) + "\n"


@pytest.fixture(scope="module")
def large() -> Graph:
    from toys import toy_registry

    return load(layered(NODES), registry=toy_registry())


class TestLarge:
    def test_plan(self, large: Graph) -> None:
        """Every node is planned to run."""
        planned = plan(large.request({"x": 1.0}), Evaluator())
        assert [entry.fate for entry in planned] == ["run"] * NODES

    def test_run(self, large: Graph) -> None:
        """Cold everything runs, warm nothing but a look at the outputs, and the values are right."""
        evaluator = Evaluator(memory=MemoryTier())
        cold = large.run(evaluator=evaluator, x=1.0)
        assert sum(record.state == "ran" for record in cold.records) == NODES + 1
        assert list(cold.values()) == pytest.approx(truth(NODES))
        warm = large.run(evaluator=evaluator, x=1.0)
        assert {record.state for record in warm.records} == {"memory"}
        assert dict(warm) == dict(cold)

    def test_chain(self, registry: Registry) -> None:
        """Depth costs no recursion: a chain as long as the graph is large."""
        graph = load(chain(NODES), registry=registry)
        assert graph.run(evaluator=Evaluator(), x=1.0)["end"] == NODES
        assert len(identities(graph.request({"x": 1.0}))) == NODES

    def test_effective(self, large: Graph) -> None:
        """The effective document is written."""
        assert large.effective(origins=False).count("\n") > 3 * NODES

    def test_values_are_let_go(self, registry: Registry) -> None:
        """A chain of arrays holds a few of them at a time, not all."""
        lines = ["graphface: 1", "nodes:", "  n0: {use: toy.grid, with: {size: 128}}"]
        lines += [f"  n{i}: {{use: toy.scale, in: {{grid: n{i - 1}}}, with: {{by: 1}}}}" for i in range(1, 200)]
        graph = load("\n".join(lines) + "\n", registry=registry)
        tracemalloc.start()
        graph.run(["n199"], evaluator=Evaluator())
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < 12 * 128 * 128 * 8
