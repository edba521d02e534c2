"""The plan says before a run what the run then does."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from toys import toy_registry

from graphface import Evaluator, Graph, MemoryTier, Observer, Registry, load
from graphface.cache.disk import DiskTier
from graphface.evaluate.plan import Planned, plan


class Called(Observer):
    """Names of the nodes that a run really called."""

    def __init__(self) -> None:
        self.names: set[str] = set()

    def node_started(self, name, step):  # type: ignore[no-untyped-def]
        if step is not None:
            self.names.add(name)


def planned(graph: Graph, evaluator: Evaluator, outputs: list[str], **inputs: object) -> dict[str, Planned]:
    return {p.name: p for p in plan(graph.request(inputs, outputs), evaluator)}


def graph_of(nodes: str, registry: Registry, inputs: str = "{}") -> Graph:
    return load(f"graphface: 1\ninputs: {inputs}\nnodes:\n{nodes}\n", registry=registry)


@st.composite
def random_graphs(draw: st.DrawFn, rules: tuple[str, ...]) -> tuple[str, list[str]]:
    """The nodes of a random graph with lazy ports, all different, and some of them to ask for."""
    nodes = ["  n0: {use: toy.number, with: {value: 1}}"]
    for i in range(1, draw(st.integers(1, 14))):
        above = st.integers(0, i - 1).map(lambda k: f"n{k}")
        kind = draw(st.sampled_from(("add", *rules)))
        a, b, sign = draw(above), draw(above), draw(st.booleans())
        match kind:
            case "add":
                nodes.append(f"  n{i}: {{use: toy.add, in: {{a: {a}, b: {b}}}, with: {{plus: {i}}}}}")
            case "gate":
                opened = str(sign).lower()
                nodes.append(f"  g{i}: {{use: toy.gate, in: {{a: {a}, extra: {b}}}, with: {{open: {opened}}}}}")
                nodes.append(f"  n{i}: {{use: toy.add, in: {{a: g{i}}}, with: {{plus: {i}}}}}")
            case "on input":
                x = "up" if sign else "down"
                nodes.append(f"  g{i}: {{use: toy.positive, in: {{a: {x}, extra: {b}}}}}")
                nodes.append(f"  n{i}: {{use: toy.add, in: {{a: g{i}, b: {a}}}, with: {{plus: {i}}}}}")
            case "on value":
                nodes.append(f"  s{i}: {{use: toy.subtract, in: {{a: {a}}}, with: {{times: {i}}}}}")
                nodes.append(f"  g{i}: {{use: toy.positive, in: {{a: s{i}, extra: {b}}}}}")
                nodes.append(f"  n{i}: {{use: toy.add, in: {{a: g{i}}}, with: {{plus: {i}.5}}}}")
    last = len(nodes) - 1
    names = [line.split(":")[0].strip() for line in nodes]
    asked = draw(st.lists(st.sampled_from(names), min_size=1, max_size=3, unique=True))
    return "\n".join(nodes), asked if draw(st.booleans()) else [names[last]]


INPUTS = "{up: {type: float, default: 1}, down: {type: float, default: -1}}"


class TestAgreement:
    @settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
    @given(random_graphs(("gate", "on input")), st.sampled_from((1, 4)), st.data())
    def test_planned_is_what_runs(
        self, graph_and_asked: tuple[str, list[str]], threads: int, data: st.DataObject
    ) -> None:
        """Where no rule has to wait, the keys of the nodes planned to run are those of the nodes called."""
        nodes, asked = graph_and_asked
        graph = graph_of(nodes, toy_registry(), INPUTS)
        called = Called()
        evaluator = Evaluator(memory=MemoryTier(), threads=threads, observers=[called])
        if data.draw(st.booleans(), "warm"):
            graph.run([data.draw(st.sampled_from([s.name for s in graph.steps]))], evaluator=evaluator)
            called.names.clear()
        before = planned(graph, evaluator, asked)
        assert "maybe" not in {p.fate for p in before.values()}
        graph.run(asked, evaluator=evaluator)
        assert {before[name].key for name in called.names} == {p.key for p in before.values() if p.fate == "run"}
        after = planned(graph, evaluator, asked)
        assert {after[name].fate for name in asked} == {"memory"}
        assert not [p for p in after.values() if p.fate == "run"]

    @settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
    @given(random_graphs(("gate", "on input", "on value")), st.sampled_from((1, 4)))
    def test_called_is_run_or_maybe(self, graph_and_asked: tuple[str, list[str]], threads: int) -> None:
        """Where rules wait for values: all that was planned to run is called, and nothing that was to be skipped."""
        nodes, asked = graph_and_asked
        graph = graph_of(nodes, toy_registry(), INPUTS)
        called = Called()
        evaluator = Evaluator(threads=threads, observers=[called])
        before = planned(graph, evaluator, asked)
        graph.run(asked, evaluator=evaluator)
        keys = {before[name].key for name in called.names}
        assert {p.key for p in before.values() if p.fate == "run"} <= keys
        assert keys <= {p.key for p in before.values() if p.fate in ("run", "maybe")}

    @settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
    @given(random_graphs(("gate", "on input", "on value")))
    def test_each_node_once(self, graph_and_asked: tuple[str, list[str]]) -> None:
        """No key is computed twice in a run, whatever rules ask for and however late, also without any tier."""
        nodes, asked = graph_and_asked
        graph = graph_of(nodes, toy_registry(), INPUTS)
        for threads in (1, 4):
            result = graph.run(asked, evaluator=Evaluator(threads=threads))
            keys = [r.key for r in result.records if r.state == "ran"]
            assert len(keys) == len(set(keys))
            assert dict(result) == dict(graph.run(asked, evaluator=Evaluator(memory=MemoryTier(budget=1))))


class TestFates:
    NODES = (
        "  a: {use: toy.number}\n  b: {use: toy.add, in: {a: a}}\n  c: {use: toy.slow, in: {a: a}}\n"
        "  d: {use: toy.gate, in: {a: b, extra: c}, with: {open: false}}\n"
        "  e: {use: toy.add, in: {a: b}, with: {plus: 9}}"
    )

    def test_reasons(self, registry: Registry) -> None:
        """What is skipped says why: declined, with the rule's reason, or not needed."""
        found = planned(graph_of(self.NODES, registry), Evaluator(), ["d"])
        assert {name: p.fate for name, p in found.items()} == {
            "a": "run",
            "b": "run",
            "c": "skipped",
            "d": "run",
            "e": "skipped",
        }
        assert str(found["c"].reason) == "the gate is shut"
        assert "d" in str(found["e"].reason)

    def test_maybe(self, registry: Registry) -> None:
        """Behind a rule that has to see a value first, nodes are maybe, with who will decide."""
        nodes = (
            "  a: {use: toy.number}\n  c: {use: toy.add, in: {a: a}}\n  k: {use: toy.slow, in: {a: c}}\n"
            "  d: {use: toy.positive, in: {a: a, extra: k}}"
        )
        found = planned(graph_of(nodes, registry), Evaluator(), ["d"])
        assert [found[n].fate for n in ("a", "c", "k", "d")] == ["run", "maybe", "maybe", "run"]
        assert "d decides" in str(found["k"].reason)

    @pytest.mark.parametrize("tier", ["memory", "disk"])
    def test_memoized(self, registry: Registry, tmp_path: Path, tier: str) -> None:
        """A memoized node is told with its tier, and what stands only behind it is skipped."""
        graph = graph_of(self.NODES, registry)
        memory = MemoryTier() if tier == "memory" else None
        evaluator = Evaluator(memory=memory, disk=DiskTier(tmp_path, 1 << 20) if tier == "disk" else None)
        graph.run(["b"], evaluator=evaluator)
        found = planned(graph, evaluator, ["e"])
        assert [found[n].fate for n in ("a", "b", "e")] == ["skipped", tier, "run"]
        assert "memoized" in str(found["a"].reason)

    def test_plan_runs_nothing(self, registry: Registry, ran: list[str]) -> None:
        """Planning calls no operator."""
        planned(graph_of(self.NODES, registry), Evaluator(), ["d", "e"])
        assert ran == []

    def test_every_node_in_order(self, registry: Registry) -> None:
        """Every node of the graph is told, in an order that runs."""
        assert next(iter(planned(graph_of(self.NODES, registry), Evaluator(), ["a"]))) == "a"
        assert len(planned(graph_of(self.NODES, registry), Evaluator(), ["a"])) == 5
