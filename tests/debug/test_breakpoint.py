"""A breakpoint stops a run at the nodes it is at, where it is wanted, and nowhere else."""

from typing import Any

import pytest
from stops import TEXT, stops

from graphface import Breakpoint, Graph, GraphfaceWarning, InputError, Registry, StopRun, load
from graphface.debug.stop import Stop
from graphface.errors import RunFailed, UsageError


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(TEXT, registry=registry)


class TestStops:
    def test_before(self, graph: Graph) -> None:
        """Before a node its arguments are there, and it has not run."""
        seen: list[Stop] = []
        stops(graph, Breakpoint("b", then=seen.append))
        (stop,) = seen
        assert (stop.name, stop.at, stop.arguments, stop.value) == ("b", "before", {"a": 2.0}, None)

    @pytest.mark.parametrize("breakpoint_", [("b", "after"), ("b:after", "before")])
    def test_after(self, graph: Graph, breakpoint_: Any) -> None:
        """After a node its value is there too."""
        seen: list[Stop] = []
        stops(graph, Breakpoint(breakpoint_[0], at=breakpoint_[1], then=seen.append))
        assert [(s.at, s.arguments, s.value) for s in seen] == [("after", {"a": 2.0}, 4.0)]

    def test_several(self, graph: Graph) -> None:
        """One breakpoint may be at several nodes."""
        seen: list[Stop] = []
        stops(graph, Breakpoint(["a:after", "c"], then=seen.append))
        assert [(s.name, s.at) for s in seen] == [("a", "after"), ("c", "before")]

    def test_when(self, graph: Graph) -> None:
        """`when` sees name, step and arguments before, the value after."""
        seen: list[Stop] = []
        stops(graph, Breakpoint("b", lambda name, step, given: given["a"] > 5, then=seen.append))
        stops(graph, Breakpoint("b", lambda name, step, value: value == 4, at="after", then=seen.append))
        assert [s.at for s in seen] == ["after"]

    def test_failed(self, graph: Graph) -> None:
        """After a node that failed there is its error, and its arguments."""
        seen: list[Stop] = []
        with pytest.raises(RunFailed):
            stops(graph, Breakpoint("bad", at="after", then=seen.append), outputs=["bad"])
        assert (seen[0].error, seen[0].arguments, seen[0].value) == ("ValueError: it broke", {"a": 2.0}, None)

    def test_next(self, graph: Graph) -> None:
        """`steps` stops before whichever node runs next, once."""
        seen: list[str] = []

        def then(stop: Stop) -> None:
            seen.append(stop.name)
            stop.steps = stop.name == "a"

        stops(graph, Breakpoint("a", then=then))
        assert seen == ["a", "b"]

    def test_threads(self, graph: Graph) -> None:
        """With threads one node stands at a time."""
        standing: list[int] = []

        def then(stop: Stop) -> None:
            standing.append(1)
            assert len(standing) == 1
            standing.pop()

        stops(graph, Breakpoint(["a", "b", "g", "p", "m"], then=then), outputs=["c", "m"], threads=4)

    def test_time_does_not_count(self, graph: Graph) -> None:
        """The time at a stop is none of the node's."""
        import time

        result = stops(graph, Breakpoint("b", then=lambda stop: time.sleep(0.2)))
        assert next(r for r in result.records if r.name == "b").seconds < 0.2

    def test_broken(self, graph: Graph) -> None:
        """What raises in `then` is the observer's mistake, not the node's."""
        with pytest.warns(GraphfaceWarning, match="switched off"):
            assert stops(graph, Breakpoint("b", then=lambda stop: 1 / 0))["c"] == 6  # type: ignore[arg-type, return-value]


class TestEnds:
    @pytest.mark.parametrize("threads", [1, 3])
    @pytest.mark.parametrize("at", ["before", "after"])
    def test_quit(self, graph: Graph, at: Any, threads: int) -> None:
        """`quit` leaves the run, as no failure of the node and no broken observer."""
        with pytest.raises(StopRun, match=f"stopped {at} node 'b'"):
            stops(graph, Breakpoint("b", at=at, then=Stop.quit), threads=threads)

    def test_unknown(self, graph: Graph) -> None:
        """A node that the graph does not have is told, with the likely one."""
        with pytest.raises(InputError, match="did you mean 'bad'"):
            Breakpoint("badd").check(graph)
        with pytest.raises(UsageError, match="did you mean 'after'"):
            Breakpoint("b:aftr")
