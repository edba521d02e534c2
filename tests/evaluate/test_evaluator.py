"""What a run promises: run / memoized / declined / failed, the same under every cache tier and every executor."""

import threading
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

from graphface import Evaluator, Graph, MemoryTier, NodeError, Observer, Registry, Result, RunFailed, load
from graphface.cache.disk import DiskTier
from graphface.errors import InputError, NonFiniteError

TIERS = ("none", "memory", "disk", "both")
THREADS = (1, 4)


@dataclass
class Lab:
    """One evaluator, and what it called since the last run began."""

    tier: str
    evaluator: Evaluator
    registry: Registry
    ran: list[str]
    loaded: list[Graph] = field(default_factory=list)

    @property
    def keeps(self) -> bool:
        return self.tier != "none"

    def load(self, nodes: str, outputs: str = "", inputs: str = "") -> Graph:
        sections = ["graphface: 1"]
        for name, body in (("inputs", inputs), ("nodes", nodes), ("outputs", outputs)):
            if body:
                sections.append(f"{name}:")
                sections += [f"  {line.strip()}" for line in body.strip().splitlines()]
        return load("\n".join(sections) + "\n", registry=self.registry)

    def run(self, graph: Graph, outputs: list[str], **inputs: object) -> Result:
        self.ran.clear()
        return graph.run(outputs, evaluator=self.evaluator, **inputs)


def build(tier: str, threads: int, folder: Path, registry: Registry, ran: list[str], **options: object) -> Lab:
    memory = MemoryTier() if tier in ("memory", "both") else None
    disk = DiskTier(folder, 1 << 26) if tier in ("disk", "both") else None
    return Lab(tier, Evaluator(memory=memory, disk=disk, threads=threads, **options), registry, ran)  # type: ignore[arg-type]


@pytest.fixture(params=[f"{tier}-{threads}" for tier in TIERS for threads in THREADS])
def lab(request: pytest.FixtureRequest, tmp_path: Path, registry: Registry, ran: list[str]) -> Lab:
    tier, threads = request.param.split("-")
    return build(tier, int(threads), tmp_path / "cache", registry, ran)


@pytest.fixture(params=[1, 4])
def quick(request: pytest.FixtureRequest, tmp_path: Path, registry: Registry, ran: list[str]) -> Iterator[Lab]:
    """A lab with a memory tier, for behaviour that no tier has a part in."""
    return build("memory", request.param, tmp_path, registry, ran)


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


class TestMemoization:
    def test_second_run(self, lab: Lab) -> None:
        """A run repeated calls nothing where a tier keeps values, and everything where none does."""
        graph = lab.load(DIAMOND)
        first = lab.run(graph, ["join"])["join"]
        assert lab.run(graph, ["join"])["join"] == first
        assert (lab.ran == []) == lab.keeps

    def test_lookup_stops_at_a_hit(self, lab: Lab) -> None:
        """What stands behind a memoized output is not even looked up."""
        graph = lab.load(DIAMOND)
        lab.run(graph, ["join"])
        touched = {r.name for r in lab.run(graph, ["join"]).records}
        assert touched == ({"join"} if lab.keeps else {"source", "left", "right", "join"})

    def test_changed_parameter(self, lab: Lab) -> None:
        """A changed parameter runs its node and what lies below, and nothing else."""
        lab.run(lab.load(DIAMOND), ["join"])
        lab.run(lab.load(DIAMOND.replace("plus: 1", "plus: 5")), ["join"])
        if lab.keeps:
            assert lab.ran == ["left", "join"]

    def test_other_graph(self, lab: Lab) -> None:
        """Equal requests share entries whatever graph they come from and whatever their nodes are called."""
        lab.run(lab.load(DIAMOND), ["left"])
        other = lab.load("s: {use: toy.number, with: {value: 3}}\nx: {use: toy.add, in: {a: s}, with: {plus: 1}}")
        assert lab.run(other, ["x"])["x"] == 4
        assert (lab.ran == []) == lab.keeps

    def test_equal_nodes_once(self, lab: Lab) -> None:
        """Equal nodes of one graph are computed once, with or without a tier."""
        graph = lab.load("""
            s: {use: toy.number}
            x: {use: toy.add, in: {a: s}, with: {plus: 1}}
            y: {use: toy.add, in: {a: s}, with: {plus: 1}}
            z: {use: toy.add, in: {a: x, b: y}}
        """)
        assert lab.run(graph, ["z", "x", "y"])["z"] == 4
        assert lab.ran.count("add") == 2

    def test_array_survives(self, lab: Lab) -> None:
        """An array comes back from a tier with the same bytes, shape and dtype."""
        graph = lab.load("g: {use: toy.grid, with: {fill: 0.1}}\ns: {use: toy.scale, in: {grid: g}}")
        first, second = lab.run(graph, ["s"])["s"], lab.run(graph, ["s"])["s"]
        assert first.dtype == second.dtype
        assert first.tobytes() == second.tobytes()
        assert (lab.ran == []) == lab.keeps

    def test_new_evaluator_finds_the_disk(self, tmp_path: Path, registry: Registry, ran: list[str]) -> None:
        """A disk tier serves the next process."""
        first = build("disk", 1, tmp_path, registry, ran)
        graph = first.load(DIAMOND)
        first.run(graph, ["join"])
        assert build("both", 1, tmp_path, registry, ran).run(graph, ["join"]).records[0].state == "disk"


class TestLazyPorts:
    GATE = """
        a: {use: toy.number, with: {value: 1}}
        costly: {use: toy.slow, in: {a: a}, with: {label: costly}}
        gate: {use: toy.gate, in: {a: a, extra: costly}, with: {open: false}}
    """
    POSITIVE = """
        a: {use: toy.number, with: {value: -1}}
        costly: {use: toy.slow, in: {a: a}, with: {label: costly}}
        gate: {use: toy.positive, in: {a: a, extra: costly}}
    """

    def test_declined_before_the_run(self, lab: Lab) -> None:
        """What is declined by a parameter alone never runs."""
        assert lab.run(lab.load(self.GATE), ["gate"])["gate"] == 1
        assert "costly" not in lab.ran

    def test_wanted_before_the_run(self, lab: Lab) -> None:
        """What the rule wants runs."""
        assert lab.run(lab.load(self.GATE.replace("false", "true")), ["gate"])["gate"] == 2
        assert "costly" in lab.ran

    def test_declined_after_a_value(self, lab: Lab) -> None:
        """A rule may look at a computed value."""
        assert lab.run(lab.load(self.POSITIVE), ["gate"])["gate"] == -1
        assert "costly" not in lab.ran

    def test_wanted_after_a_value(self, lab: Lab) -> None:
        """What a rule wants after seeing a value runs then, and what it shares with others is not run again."""
        assert lab.run(lab.load(self.POSITIVE.replace("-1", "2")), ["gate"])["gate"] == 4
        assert sorted(lab.ran) == ["costly", "number", "positive"]

    def test_value_used_before_and_after_the_decision(self, lab: Lab) -> None:
        """A value whose other users are done by the time a rule wants it was not computed twice."""
        graph = lab.load("""
            base: {use: toy.number, with: {value: 1, label: base}}
            shared: {use: toy.add, in: {a: base}, with: {plus: 5, label: shared}}
            early: {use: toy.add, in: {a: shared}, with: {label: early}}
            late: {use: toy.add, in: {a: shared}, with: {plus: 1, label: late}}
            gate: {use: toy.positive, in: {a: early, extra: late}, with: {label: gate}}
        """)
        assert lab.run(graph, ["gate"])["gate"] == 13
        assert sorted(lab.ran) == ["base", "early", "gate", "late", "shared"]

    def test_reason(self, quick: Lab) -> None:
        """The reason stands in the records."""
        declined = [r for r in quick.run(quick.load(self.GATE), ["gate"]).records if r.state == "declined"]
        assert [(r.name, r.reason) for r in declined] == [("gate.extra", "the gate is shut")]

    def test_unplugged(self, lab: Lab) -> None:
        """A lazy port that nothing is plugged into is None."""
        assert lab.run(lab.load("a: {use: toy.number}\ngate: {use: toy.gate, in: {a: a}}"), ["gate"])["gate"] == 1

    def test_rule_on_an_input(self, lab: Lab) -> None:
        """A rule that looks at a graph input decides before the run, anew for every input."""
        nodes = (
            "costly: {use: toy.slow, in: {a: x}, with: {label: costly}}\n"
            "gate: {use: toy.positive, in: {a: x, extra: costly}}"
        )
        graph = lab.load(nodes, inputs="x: float")
        assert [lab.run(graph, ["gate"], x=x)["gate"] for x in (1.0, -1.0, 2.0, -1.0)] == [2, -1, 4, -1]

    def test_numpy_answer(self, quick: Lab) -> None:
        """A rule may answer with NumPy's bool."""
        graph = quick.load("g: {use: toy.numpy_gate, in: {a: x, extra: x}}", inputs="x: float")
        assert [quick.run(graph, ["g"], x=x)["g"] for x in (1.0, -1.0)] == [2, -1]

    def test_declined_value_does_not_count(self, lab: Lab) -> None:
        """What is declined before the run has no part in the key."""
        lab.run(lab.load(self.GATE), ["gate"])
        lab.run(lab.load(self.GATE.replace("label: costly", "seconds: 0.001")), ["gate"])
        assert (lab.ran == []) == lab.keeps

    def test_long_chain(self, quick: Lab) -> None:
        """Thousands of lazy ports behind each other need no recursion."""
        nodes = ["n0: {use: toy.number}"]
        nodes += [f"n{i}: {{use: toy.positive, in: {{a: x, extra: n{i - 1}}}}}" for i in range(1, 2000)]
        graph = quick.load("\n".join(nodes), inputs="x: float")
        quick.run(graph, ["n0"], x=0.5)
        assert quick.run(graph, ["n1999"], x=0.5)["n1999"] == 1 + 1999 * 0.5
        assert quick.run(graph, ["n1999"], x=0.25)["n1999"] == 1 + 1999 * 0.25

    @pytest.mark.parametrize("a", ["x", "n"], ids=["before the run", "in the run"])
    def test_failing_rule(self, quick: Lab, a: str) -> None:
        """A rule that raises is that node's failure."""
        nodes = f"n: {{use: toy.number}}\ng: {{use: toy.broken_rule, in: {{a: {a}, extra: n}}}}"
        graph = quick.load(nodes, inputs="x: {type: float, default: 1}")
        for _ in range(2):
            with pytest.raises(RunFailed) as caught:
                quick.run(graph, ["g"])
            assert caught.value.failures[0].node == "g"
            assert isinstance(caught.value.failures[0].__cause__, LookupError)
        assert quick.run(graph, ["n"])["n"] == 1


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


class TestGuard:
    NODES = """
        g: {use: toy.grid}
        p: {use: toy.poison, in: {grid: g}, with: {row: 2}}
        s: {use: toy.scale, in: {grid: p}}
    """

    def test_names_the_first(self, lab: Lab) -> None:
        """The first node to give NaN is named, with how many, where, and its inputs."""
        with pytest.raises(RunFailed) as caught:
            lab.run(lab.load(self.NODES), ["s"])
        (failure,) = caught.value.failures
        assert isinstance(failure, NonFiniteError)
        assert failure.node == "p"
        assert "1 non-finite of 16" in failure.reason
        assert "[2, 1]" in failure.reason
        assert failure.inputs["grid"].startswith("float64[4, 4]")

    def test_nothing_below_runs(self, lab: Lab) -> None:
        """What stands below the guard's node is not called."""
        with pytest.raises(RunFailed):
            lab.run(lab.load(self.NODES), ["s"])
        assert "scale" not in lab.ran

    def test_warn(self, quick: Lab) -> None:
        """With `warn` the value passes and the result says so."""
        quick.evaluator.guard = "warn"
        result = quick.run(quick.load(self.NODES), ["s"])
        assert np.isnan(result["s"]).sum() == 1
        assert any(w.startswith("p: ") for w in result.warnings)

    def test_off(self, quick: Lab) -> None:
        """With `off` nobody looks."""
        quick.evaluator.guard = "off"
        result = quick.run(quick.load(self.NODES), ["s"])
        assert np.isnan(result["s"]).sum() == 1
        assert result.warnings == []

    @pytest.mark.parametrize("value", [np.float64("nan"), float("inf"), np.float64("-inf")])
    def test_scalar(self, quick: Lab, value: float) -> None:
        """A number that is not finite is caught like an array's."""
        graph = quick.load("s: {use: toy.same, in: {value: x}}", inputs="x: float")
        with pytest.raises(RunFailed) as caught:
            quick.run(graph, ["s"], x=value)
        assert isinstance(caught.value.failures[0], NonFiniteError)

    def test_empty_array(self, quick: Lab) -> None:
        """An array of no elements is finite."""
        graph = quick.load("s: {use: toy.same, in: {value: x}}", inputs="x: Any")
        assert quick.run(graph, ["s"], x=np.zeros((0, 3)))["s"].shape == (0, 3)


class TestWarnings:
    def test_collected(self, quick: Lab) -> None:
        """A node's fallback lands in the result beside the node's name."""
        nodes = "a: {use: toy.number}\nf: {use: toy.fall_back, in: {a: a}}"
        assert quick.run(quick.load(nodes), ["f"]).warnings == ["f: 1.0 was too much"]

    def test_collector_is_put_back(self, quick: Lab) -> None:
        """After a run, also an interrupted one, `warn` is an ordinary Python warning again."""
        from graphface import GraphfaceWarning, warn

        graph = quick.load("a: {use: toy.number}\ni: {use: toy.interrupt, in: {a: a}}")
        with pytest.raises(KeyboardInterrupt):
            quick.run(graph, ["i"])
        with pytest.warns(GraphfaceWarning):
            warn("outside")


class TestImmutability:
    def test_outputs_are_read_only(self, lab: Lab) -> None:
        """An array that a run gives cannot be written to, memoized or not."""
        graph = lab.load("g: {use: toy.grid}\np: {use: toy.pair, in: {grid: g}}")
        for _ in range(2):
            result = lab.run(graph, ["g", "p"])
            for array in (result["g"], result["p"].low, result["p"].high):
                with pytest.raises(ValueError, match="read-only"):
                    array[0, 0] = 5

    def test_inputs_of_nodes_are_read_only(self, quick: Lab) -> None:
        """A node cannot write into what another node gave."""
        graph = quick.load("g: {use: toy.grid}\nw: {use: toy.write, in: {grid: g}}")
        with pytest.raises(RunFailed) as caught:
            quick.run(graph, ["w"])
        assert caught.value.failures[0].node == "w"

    def test_caller_keeps_his_array(self, lab: Lab) -> None:
        """An array given to a run stays writable, and no node can write to it."""
        graph = lab.load("w: {use: toy.write, in: {grid: x}}\ns: {use: toy.scale, in: {grid: x}}", inputs="x: Grid")
        given = np.zeros((3, 3))
        with pytest.raises(RunFailed):
            lab.run(graph, ["w", "s"], x=given)
        assert given.flags.writeable
        assert given[0, 0] == 0

    @pytest.mark.parametrize("wrap", [lambda a: [a], lambda a: [[a]], lambda a: [a[:2]]])
    def test_caller_keeps_nested_arrays(self, quick: Lab, wrap: object) -> None:
        """The same for arrays inside lists, views included."""
        graph = quick.load("s: {use: toy.same, in: {value: x}}", inputs="x: Any")
        given = wrap(np.zeros((3, 3)))  # type: ignore[operator]
        inner = given[0][0] if isinstance(given[0], list) else given[0]
        result = quick.run(graph, ["s"], x=given)["s"]
        assert inner.flags.writeable
        passed = result[0][0] if isinstance(result[0], list) else result[0]
        assert not passed.flags.writeable

    def test_caller_keeps_dataclass_arrays(self, quick: Lab) -> None:
        """The same for arrays inside a dataclass."""
        from toys import Pair

        graph = quick.load(
            "m: {use: toy.mean, in: {grid: x.low}}\ns: {use: toy.same, in: {value: x}}", inputs="x: Pair"
        )
        given = Pair(np.ones((2, 2)), np.ones((2, 2)))
        result = quick.run(graph, ["m", "s"], x=given)["s"]
        assert given.low.flags.writeable
        assert not result.low.flags.writeable
        assert not result.high.flags.writeable

    @pytest.mark.parametrize("writable", [True, False])
    def test_copied_only_where_writable(self, quick: Lab, writable: bool) -> None:
        """An array that nobody can write to passes through without a copy; any other is copied."""
        graph = quick.load("s: {use: toy.same, in: {value: x}}", inputs="x: Grid")
        given = np.zeros((3, 3))
        given.flags.writeable = writable
        assert np.shares_memory(quick.run(graph, ["s"], x=given)["s"], given) is not writable

    def test_caller_writes_later(self, lab: Lab) -> None:
        """What the caller writes into an array after a run cannot reach memoized values."""
        graph = lab.load("s: {use: toy.same, in: {value: x}}\nm: {use: toy.mean, in: {grid: x}}", inputs="x: Grid")
        given = np.zeros((3, 3))
        assert lab.run(graph, ["m", "s"], x=given)["m"] == 0
        given[:] = 7
        assert lab.run(graph, ["m"], x=given)["m"] == 7
        again = lab.run(graph, ["m", "s"], x=np.zeros((3, 3)))
        assert again["m"] == 0
        assert again["s"].max() == 0


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
