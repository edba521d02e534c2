"""From a stop a run goes on with another value, and no cache takes that value for the node's own."""

from typing import Any

import numpy as np
import pytest
from stops import TEXT, stops

from graphface import Breakpoint, Evaluator, Graph, InputError, MemoryTier, Registry, load
from graphface.debug.stop import Stop


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(TEXT, registry=registry)


class TestReplaces:
    def replaced(self, graph: Graph, node: str, value: Any, name: str = "", threads: int = 1) -> Any:
        """The result of a run in which a value was replaced at the first stop."""
        seen: list[str] = []

        def then(stop: Stop) -> None:
            seen.append(stop.name)
            if len(seen) == 1:
                stop.replace(value, name)

        return stops(graph, Breakpoint(node, then=then), threads=threads), seen

    @pytest.mark.parametrize("threads", [1, 3])
    def test_this_node(self, graph: Graph, ran: list[str], threads: int) -> None:
        """The value stands in for the node; what was computed before the stop is not computed again."""
        result, seen = self.replaced(graph, "b", 100.0, threads=threads)
        assert result["c"] == 102
        assert (seen, ran) == (["b"], ["a", "c"])

    def test_port(self, graph: Graph) -> None:
        """What is plugged into a port is replaced for all that use it; the run stops at the node again."""
        result, seen = self.replaced(graph, "b", 10.0, "a")
        assert result["c"] == 22
        assert seen == ["b", "b"]

    def test_input(self, graph: Graph) -> None:
        """A port that a graph input is plugged into changes the input."""
        assert self.replaced(graph, "a", 5.0, "a")[0]["c"] == 14

    def test_nothing_kept(self, graph: Graph) -> None:
        """The same evaluator gives the node's own result afterwards."""
        evaluator = Evaluator(memory=MemoryTier())
        stop = Breakpoint("b", then=lambda stop: stop.replace(50.0))
        assert evaluator.run(graph.request(), [stop])["c"] == 52
        assert evaluator.run(graph.request())["c"] == 6

    @pytest.mark.parametrize(
        ("node", "outputs", "name", "said"),
        [("t", ["t"], "values", "one of a, b"), ("m", ["m"], "grid", "the whole of 'p'"), ("b", None, "b", "plugged")],
    )
    def test_refused(self, graph: Graph, node: str, outputs: Any, name: str, said: str) -> None:
        """What is no single whole value cannot be replaced by the name of its port, and the run still stands."""
        told: list[str] = []

        def then(stop: Stop) -> None:
            with pytest.raises(InputError) as caught:
                stop.replace(np.ones(2), name)
            told.append(str(caught.value))

        stops(graph, Breakpoint(node, then=then), outputs=outputs)
        assert said in told[0]
