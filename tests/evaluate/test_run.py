"""One run: only what is needed, each once, whatever fails, on any number of threads."""

import threading
from pathlib import Path

import numpy as np
import pytest
from evaluator_lab import Lab, build

from graphface import Graph, NodeError, Observer, Registry, RunFailed
from graphface.errors import InputError

DIAMOND = """
    source: {use: toy.number, with: {value: 3, label: source}}
    left: {use: toy.add, in: {a: source}, with: {plus: 1, label: left}}
    right: {use: toy.add, in: {a: source}, with: {plus: 2, label: right}}
    join: {use: toy.add, in: {a: left, b: right}, with: {label: join}}
    aside: {use: toy.add, in: {a: source}, with: {plus: 9, label: aside}}
"""


class TestDemand:
    def test_value(self, lab: Lab) -> None:
        """An output is what its operators compute."""
        assert lab.run(lab.load(DIAMOND), ["join"])["join"] == 9

    def test_only_what_is_needed(self, lab: Lab) -> None:
        """A node that no requested output needs is never called."""
        lab.run(lab.load(DIAMOND), ["join"])
        assert sorted(lab.ran) == ["join", "left", "right", "source"]

    def test_intermediate(self, lab: Lab) -> None:
        """Asking for an intermediate runs nothing below it."""
        lab.run(lab.load(DIAMOND), ["left"])
        assert lab.ran == ["source", "left"]

    def test_each_once(self, lab: Lab) -> None:
        """A node that several others need is called once."""
        lab.run(lab.load(DIAMOND), ["join", "aside", "left"])
        assert sorted(lab.ran) == ["aside", "join", "left", "right", "source"]

    def test_order(self, lab: Lab) -> None:
        """A node is called after everything it depends on."""
        lab.run(lab.load(DIAMOND), ["join"])
        assert lab.ran[0] == "source"
        assert lab.ran[-1] == "join"

    def test_no_outputs(self, lab: Lab) -> None:
        """Asking for nothing runs nothing."""
        assert dict(lab.run(lab.load(DIAMOND), [])) == {}
        assert lab.ran == []

    def test_field(self, lab: Lab) -> None:
        """`node.field` is the field of the value."""
        graph = lab.load("g: {use: toy.grid}\np: {use: toy.pair, in: {grid: g}}\nm: {use: toy.mean, in: {grid: p.low}}")
        assert lab.run(graph, ["m", "p.high"])["m"] == 1
        assert lab.run(graph, ["p.high"])["p.high"].shape == (4, 4)

    def test_result_is_a_mapping(self, quick: Lab) -> None:
        """A result offers what every mapping does."""
        result = quick.run(quick.load(DIAMOND), ["left", "right"])
        assert dict(result.items()) == {"left": 4, "right": 5}
        assert sorted(result.values()) == [4, 5]

    def test_deep(self, quick: Lab) -> None:
        """A chain of thousands of nodes needs no recursion."""
        nodes = ["n0: {use: toy.number}", *(f"n{i}: {{use: toy.add, in: {{a: n{i - 1}}}}}" for i in range(1, 3000))]
        assert quick.run(quick.load("\n".join(nodes)), ["n2999"])["n2999"] == 1

    def test_list_port(self, lab: Lab) -> None:
        """Several wires into a list port arrive in the order written."""
        graph = lab.load("""
            one: {use: toy.number, with: {value: 1}}
            two: {use: toy.number, with: {value: 2}}
            all: {use: toy.total, in: {values: [one, two, one]}}
            none: {use: toy.total, in: {values: []}}
        """)
        result = lab.run(graph, ["all", "none"])
        assert (result["all"], result["none"]) == (4, 0)


class TestFailures:
    BROKEN = """
        a: {use: toy.number, with: {value: 2}}
        bad: {use: toy.fail, in: {a: a}}
        below: {use: toy.add, in: {a: bad}, with: {label: below}}
        good: {use: toy.add, in: {a: a}, with: {plus: 1, label: good}}
    """

    def failure(self, lab: Lab, graph: Graph, outputs: list[str], **inputs: object) -> tuple[RunFailed, NodeError]:
        with pytest.raises(RunFailed) as caught:
            lab.run(graph, outputs, **inputs)
        return caught.value, caught.value.failures[0]

    def test_parts(self, lab: Lab) -> None:
        """A failure names node, operator, place and inputs, and has the original exception as cause."""
        _, failure = self.failure(lab, lab.load(self.BROKEN), ["below"])
        assert (failure.node, failure.operator) == ("bad", "toy.fail")
        assert failure.place is not None
        assert (failure.place.line, failure.place.column) == (4, 3)
        assert failure.inputs == {"a": "2.0"}
        assert isinstance(failure.__cause__, ValueError)

    def test_independent_branch_finishes(self, lab: Lab) -> None:
        """Outputs that do not need the failed node are computed and handed over."""
        error, _ = self.failure(lab, lab.load(self.BROKEN), ["below", "good"])
        assert error.finished == {"good": 3}

    def test_independent_branch_stays(self, lab: Lab) -> None:
        """What was computed beside a failure stays memoized; the failure does not."""
        graph = lab.load(self.BROKEN)
        self.failure(lab, graph, ["below", "good"])
        self.failure(lab, graph, ["below", "good"])
        assert (lab.ran == ["fail"]) == lab.keeps

    def test_below_is_blocked(self, lab: Lab) -> None:
        """What stands below a failure is not called, and is recorded as blocked."""
        states: dict[str, str] = {}

        class Watch(Observer):
            def node_finished(self, record, step, value):  # type: ignore[no-untyped-def]
                states[record.name] = record.state

        lab.evaluator.observers = (Watch(),)
        self.failure(lab, lab.load(self.BROKEN), ["below"])
        assert states == {"a": "ran", "bad": "failed", "below": "blocked"}
        assert "below" not in lab.ran

    def test_all_are_told(self, lab: Lab) -> None:
        """Every failure of a run is reported, not only the first."""
        nodes = self.BROKEN + "worse: {use: toy.fail, in: {a: good}, with: {message: worse}}"
        error, _ = self.failure(lab, lab.load(nodes), ["below", "worse"])
        assert sorted(f.node for f in error.failures) == ["bad", "worse"]

    def test_wrong_type_returned(self, quick: Lab) -> None:
        """An operator that breaks its declaration fails by name, before anything gets its value."""
        nodes = "a: {use: toy.number}\nw: {use: toy.wrong, in: {a: a}}\nm: {use: toy.mean, in: {grid: w}}"
        _, failure = self.failure(quick, quick.load(nodes), ["m"])
        assert failure.node == "w"
        assert isinstance(failure.__cause__, TypeError)

    def test_missing_input(self, quick: Lab) -> None:
        """An input that is needed and was not given is named."""
        graph = quick.load("s: {use: toy.add, in: {a: x}}\nt: {use: toy.number}", inputs="x: float")
        with pytest.raises(InputError) as caught:
            quick.run(graph, ["s"])
        assert caught.value.name == "x"
        assert quick.run(graph, ["t"])["t"] == 1

    @pytest.mark.parametrize("error", [OSError("disk on fire"), RuntimeError("odd"), MemoryError()])
    def test_failing_reader(self, quick: Lab, error: Exception) -> None:
        """A value that cannot be loaded is an error of its input, and no thread waits for it."""
        graph = quick.load("s: {use: toy.add, in: {a: x}}", inputs="x: float")
        bound = graph.bind({"x": 1.0})

        def load() -> None:
            raise error

        bound["x"].load = load
        with pytest.raises(InputError) as caught:
            quick.evaluator.run(graph.request(bound, ["s"]))
        assert caught.value.name == "x"

    def test_field_of_nothing(self, quick: Lab) -> None:
        """A field of a value that may be None may itself be None."""
        nodes = """
            g: {use: toy.grid}
            p: {use: toy.maybe_pair, in: {grid: g}, with: {give: false}}
            s: {use: toy.takes_none, in: {grid: p.low}}
        """
        assert quick.run(quick.load(nodes), ["s"])["s"] == -1


class TestThreads:
    @pytest.mark.parametrize("threads", [1, 2, 8])
    def test_same_result(self, threads: int, tmp_path: Path, registry: Registry, ran: list[str]) -> None:
        """The number of threads changes neither values nor which nodes ran."""
        nodes = ["a0: {use: toy.number, with: {value: 2, label: a0}}"]
        for i in range(1, 40):
            above = f"a: a{(i * 7) % i}, b: a{i - 1}"
            nodes.append(f"a{i}: {{use: toy.subtract, in: {{{above}}}, with: {{times: {i % 3}, label: a{i}}}}}")
        lab = build("memory", threads, tmp_path, registry, ran)
        result = lab.run(lab.load("\n".join(nodes)), ["a39", "a20"])
        called = sorted(ran)
        single = build("memory", 1, tmp_path, registry, ran)
        assert dict(result) == dict(single.run(single.load("\n".join(nodes)), ["a39", "a20"]))
        assert called == sorted(ran)

    def test_branches_overlap(self, tmp_path: Path, registry: Registry, ran: list[str]) -> None:
        """Independent nodes are under way at the same time, never more than allowed."""
        under_way, most = set(), 0
        both = threading.Barrier(2, timeout=10)

        class Watch(Observer):
            def node_started(self, name, step):  # type: ignore[no-untyped-def]
                nonlocal most
                if name.startswith("s"):
                    under_way.add(name)
                    most = max(most, len(under_way))
                    both.wait()

            def node_finished(self, record, step, value):  # type: ignore[no-untyped-def]
                under_way.discard(record.name)

        lab = build("none", 2, tmp_path, registry, ran, observers=[Watch()])
        nodes = "a: {use: toy.number}\n" + "\n".join(
            f"s{i}: {{use: toy.slow, in: {{a: a}}, with: {{seconds: 0.00{i}}}}}" for i in range(4)
        )
        lab.run(lab.load(nodes), ["s0", "s1", "s2", "s3"])
        assert most == 2


class TestMemory:
    def test_values_are_released(self, quick: Lab) -> None:
        """A value is let go once its last user is done."""
        import gc
        import weakref

        quick.evaluator.memory = None
        alive: list[weakref.ref[np.ndarray]] = []
        most = 0

        class Watch(Observer):
            def node_finished(self, record, step, value):  # type: ignore[no-untyped-def]
                nonlocal most
                alive.append(weakref.ref(value))
                gc.collect(0)
                most = max(most, sum(r() is not None for r in alive))

        quick.evaluator.observers = (Watch(),)
        nodes = ["g0: {use: toy.grid}", *(f"g{i}: {{use: toy.scale, in: {{grid: g{i - 1}}}}}" for i in range(1, 12))]
        quick.run(quick.load("\n".join(nodes)), ["g11"])
        assert most <= 3


class TestInterrupt:
    def test_memo_stays_valid(self, lab: Lab) -> None:
        """A run that is interrupted leaves what it computed, and the next one goes on from there."""
        graph = lab.load("""
            a: {use: toy.number, with: {label: a}}
            b: {use: toy.add, in: {a: a}, with: {label: b}}
            c: {use: toy.interrupt, in: {a: b}}
            d: {use: toy.add, in: {a: b}, with: {plus: 1, label: d}}
        """)
        with pytest.raises(KeyboardInterrupt):
            lab.run(graph, ["c"])
        assert lab.run(graph, ["d"])["d"] == 2
        assert lab.ran == (["d"] if lab.keeps else ["a", "b", "d"])

    def test_observers_hear_of_the_end(self, quick: Lab) -> None:
        """`run_finished` is called also where the run was interrupted."""
        ended: list[int] = []

        class Watch(Observer):
            def run_finished(self, records):  # type: ignore[no-untyped-def]
                ended.append(len(records))

        quick.evaluator.observers = (Watch(),)
        with pytest.raises(KeyboardInterrupt):
            quick.run(quick.load("a: {use: toy.number}\ni: {use: toy.interrupt, in: {a: a}}"), ["i"])
        assert ended == [1]
