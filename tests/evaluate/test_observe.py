"""Observers look on; one that breaks is switched off and the run goes on."""

import threading
import warnings
from typing import Any

import pytest

from graphface import Evaluator, Graph, GraphfaceWarning, MemoryTier, Observer, Registry, StopRun, load
from graphface.evaluate.observe import Hooks

HOOKS = ("run_started", "node_started", "node_called", "node_finished", "run_finished")


@pytest.fixture
def graph(registry: Registry) -> Graph:
    nodes = "a: {use: toy.number}\n  b: {use: toy.add, in: {a: a}}\n  c: {use: toy.add, in: {a: a, b: b}}\n"
    return load(f"graphface: 1\nnodes:\n  {nodes}outputs: {{y: c}}\n", registry=registry)


class Counting(Observer):
    """Counts calls of each hook, and breaks where it is told to."""

    def __init__(self, broken: str = "", error: type[BaseException] = ZeroDivisionError) -> None:
        self.calls: list[str] = []
        self._broken, self._error = broken, error

    def _called(self, hook: str) -> None:
        self.calls.append(hook)
        if hook == self._broken:
            raise self._error("on purpose")

    def run_started(self, *_: Any) -> None:
        self._called("run_started")

    def node_started(self, *_: Any) -> None:
        self._called("node_started")

    def node_called(self, *_: Any) -> None:
        self._called("node_called")

    def node_finished(self, *_: Any) -> None:
        self._called("node_finished")

    def run_finished(self, *_: Any) -> None:
        self._called("run_finished")


class TestBroken:
    @pytest.mark.parametrize("threads", [1, 3])
    @pytest.mark.parametrize("hook", HOOKS)
    def test_switched_off(self, graph: Graph, hook: str, threads: int) -> None:
        """Whichever hook breaks, the observer hears no more, the others do, and the run has its result."""
        broken, sound = Counting(hook), Counting()
        evaluator = Evaluator(threads=threads, observers=[broken, sound])
        with pytest.warns(GraphfaceWarning) as told:
            result = graph.run(evaluator=evaluator)
        assert result["y"] == 2
        assert result.warnings == []
        assert sound.calls == ["run_started", *["node_started", "node_called", "node_finished"] * 3, "run_finished"]
        assert broken.calls == sound.calls[: sound.calls.index(hook) + 1]
        (warning,) = told
        assert f"Counting.{hook} raised ZeroDivisionError: on purpose ({__file__}:" in str(warning.message)

    def test_next_run(self, graph: Graph) -> None:
        """It takes part in the next run again."""
        broken = Counting("node_finished")
        evaluator = Evaluator(observers=[broken])
        for _ in range(2):
            with pytest.warns(GraphfaceWarning):
                graph.run(evaluator=evaluator)
        assert broken.calls.count("run_started") == 2

    def test_other_threads(self) -> None:
        """Breaking on several threads at once is told once."""
        barrier = threading.Barrier(4, timeout=10)

        class Together(Observer):
            def node_started(self, name: str, step: Any) -> None:
                barrier.wait()
                raise LookupError

        (hook,) = Hooks([Together()]).node_started
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            threads = [threading.Thread(target=hook, args=("a", None)) for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        assert len(told) == 1

    @pytest.mark.parametrize("threads", [1, 3])
    @pytest.mark.parametrize("hook", HOOKS)
    def test_interrupt(self, graph: Graph, hook: str, threads: int) -> None:
        """A hook may end the run as Ctrl-C does."""
        evaluator = Evaluator(threads=threads, observers=[Counting(hook, KeyboardInterrupt)])
        with pytest.raises(KeyboardInterrupt):
            graph.run(evaluator=evaluator)


class TestCalled:
    def test_arguments(self, graph: Graph) -> None:
        """`node_called` is told the values of the ports, of nodes that run and of no other."""
        heard: list[tuple[str, dict[str, Any]]] = []

        class Hearing(Observer):
            def node_called(self, name: str, step: Any, arguments: Any) -> None:
                heard.append((name, dict(arguments)))

        evaluator = Evaluator(memory=MemoryTier(), observers=[Hearing()])
        for _ in range(2):
            graph.run(evaluator=evaluator)
        assert heard == [("a", {}), ("b", {"a": 1.0}), ("c", {"a": 1.0, "b": 1.0})]


class TestStopped:
    @pytest.mark.parametrize("threads", [1, 3])
    @pytest.mark.parametrize("hook", HOOKS)
    def test_leaves(self, graph: Graph, hook: str, threads: int) -> None:
        """`StopRun` leaves the run from any hook; whoever runs gets it, and the observer is not switched off."""
        evaluator = Evaluator(threads=threads, observers=[Counting(hook, StopRun)])
        with pytest.raises(StopRun, match="on purpose"):
            graph.run(evaluator=evaluator)

    def test_instead(self, graph: Graph) -> None:
        """With a request it is run instead, by the same evaluator under the same observers."""
        started: list[Any] = []

        class Once(Observer):
            def run_started(self, request: Any) -> None:
                started.append(request)
                if len(started) == 1:
                    raise StopRun("again", graph.request({}, ["a"]))

        assert dict(Evaluator().run(graph.request(), [Once()])) == {"a": 1.0}
        assert len(started) == 2


class TestOverridden:
    def test_none(self) -> None:
        """Without observers, and for hooks that nobody overrides, there is nothing to call."""
        assert Hooks([]).any is False
        hooks = Hooks([Observer()])
        assert all(getattr(hooks, name) == () for name in HOOKS)

    def test_order(self, graph: Graph) -> None:
        """Observers are called in the order in which they were given."""
        heard: list[str] = []

        def hearing(name: str) -> Observer:
            class One(Observer):
                def run_started(self, steps: Any) -> None:
                    heard.append(name)

            return One()

        graph.run(evaluator=Evaluator(memory=MemoryTier(), observers=[hearing("first"), hearing("second")]))
        assert heard == ["first", "second"]
