"""A graph from outside: its name, its edges, what lies behind a node."""

import pytest
from graph_texts import SUMS

from graphface import Graph, Registry, load


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(SUMS, registry=registry)


class TestOutside:
    def test_repr(self, graph: Graph) -> None:
        """A graph prints as its name, size and outputs."""
        assert repr(graph) == "Graph('sums', 3 nodes, outputs: y, low)"

    def test_networkx(self, graph: Graph) -> None:
        """As a networkx graph its edges carry the ports."""
        drawn = graph.networkx()
        assert set(drawn.nodes) == {"x", "g", "a", "p", "m"}
        assert drawn.edges["p", "m"]["port"] == "grid"
        assert drawn.nodes["a"]["operator"] == "toy.add"

    def test_behind(self, graph: Graph) -> None:
        """What may be needed is known without running, in an order that runs."""
        slots = graph.behind(graph.targets(["m"]).values())
        names = [*graph.input_names, *(step.name for step in graph.steps)]
        assert [names[slot] for slot in slots] == ["g", "p", "m"]

    def test_thousand_nodes(self, registry: Registry) -> None:
        """A large graph loads and runs whole."""
        nodes = ["  n0: {use: toy.number}"]
        nodes += [f"  n{i}: {{use: toy.add, in: {{a: n{i - 1}, b: n{i // 2}}}}}" for i in range(1, 60)]
        nodes += [f"  m{i}: {{use: toy.add, in: {{a: n{i % 60}}}, with: {{plus: {i}}}}}" for i in range(1000)]
        loaded = load("graphface: 1\nnodes:\n" + "\n".join(nodes) + "\n", registry=registry)
        asked = [f"m{i}" for i in range(1000)]
        assert loaded.run(asked)["m0"] == 1
