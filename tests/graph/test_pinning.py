"""A pinned value stands in for a node: nothing above it is needed, nothing below it is taken for the node's own."""

import threading
from pathlib import Path

import numpy as np
import pytest
from evaluator_lab import Lab
from history_lab import Lab as HistoryLab
from hypothesis import given
from hypothesis import strategies as st
from toys import toy_registry

from graphface import Evaluator, Graph, InputError, MemoryTier, Registry, UnreadableFile, load
from graphface.evaluate.plan import plan
from graphface.graph.request import changed
from graphface.values.value_file import write_value

TEXT = """graphface: 1
name: pins
inputs: {x: float}
nodes:
  a: {use: toy.add, in: {a: x}, with: {plus: 1}}
  b: {use: toy.add, in: {a: a}, with: {plus: 2}}
  g: {use: toy.grid}
  p: {use: toy.pair, in: {grid: g}}
  m: {use: toy.mean, in: {grid: p.low}}
  y: {use: toy.positive, in: {a: b, extra: m}}
outputs: {y: y, b: b}
"""


@pytest.fixture
def graph(registry: Registry) -> Graph:
    return load(TEXT, registry=registry)


class TestRuns:
    def test_nothing_above(self, lab: Lab) -> None:
        """The node and what only it needs do not run, and their inputs need not be given."""
        graph = load(TEXT, registry=lab.registry)
        result = lab.evaluator.run(graph.request({}, ["b"], pinned={"a": 10.0}))
        assert result["b"] == 12
        assert lab.ran == ["add"]

    def test_record(self, graph: Graph) -> None:
        """Its record reads like that of an input, under the word "pinned"."""
        records = Evaluator().run(graph.request({}, ["b"], pinned={"a": 10.0})).records
        assert [(r.name, r.operator, r.state) for r in records] == [("a", "pinned", "ran"), ("b", "toy.add", "ran")]

    def test_asked_for(self, graph: Graph) -> None:
        """A pinned node that is asked for gives the pinned value; a field of one is taken of it."""
        assert Evaluator().run(graph.request({}, ["b"], pinned={"b": 7.0}))["b"] == 7
        pair = graph.run(["p"], evaluator=Evaluator())["p"]
        assert Evaluator().run(graph.request({}, ["p.high"], pinned={"p": pair}))["p.high"].max() == 2

    def test_undecided_rule(self, graph: Graph) -> None:
        """A `needs` rule sees the pinned value."""
        run = Evaluator().run
        assert run(graph.request({}, ["y"], pinned={"b": -1.0}))["y"] == -1
        assert run(graph.request({}, ["y"], pinned={"b": 1.0, "m": 5.0}))["y"] == 6

    def test_never_kept_as_its_own(self, lab: Lab) -> None:
        """With any tier, what was computed from a pinned value is not found without it, nor the other way round."""
        graph = load(TEXT, registry=lab.registry)
        expected = lab.run(graph, ["y"], x=3.0)["y"]
        assert lab.evaluator.run(graph.request({"x": 3.0}, ["y"], pinned={"a": 100.0}))["y"] != expected
        assert lab.run(graph, ["y"], x=3.0)["y"] == expected
        assert lab.run(graph, ["a"], x=3.0)["a"] == 4

    def test_memoized(self, quick: Lab) -> None:
        """The same value pinned again finds what was computed from it."""
        graph = load(TEXT, registry=quick.registry)
        for _ in range(2):
            quick.ran.clear()
            quick.evaluator.run(graph.request({}, ["b"], pinned={"a": 10.0}))
        assert quick.ran == []

    def test_arrays_are_copied(self, graph: Graph) -> None:
        """The owner of a pinned array may go on writing to it."""
        own = np.ones((2, 2))
        asked = graph.request({}, ["g"], pinned={"g": own})
        own[0, 0] = 5
        assert Evaluator().run(asked)["g"].max() == 1


NODES = ["a", "b", "g", "p", "m", "y"]


class TestKeys:
    @given(st.sets(st.sampled_from(NODES), min_size=1), st.floats(-4, 4))
    def test_own_value(self, names: set[str], x: float) -> None:
        """Pinned with what they give themselves, nodes give equal results under keys that no node has."""
        graph = load(TEXT, registry=toy_registry())
        plain = graph.request({"x": x}, NODES)
        own = Evaluator().run(plain)
        pinned = graph.request({"x": x}, NODES, pinned={name: own[name] for name in names})
        again = Evaluator().run(pinned)
        for name in ("a", "b", "m", "y"):
            assert again[name] == own[name]
        below = {
            s.slot
            for s in graph.steps
            if names & {graph.names[b] for b in graph.behind(graph.targets([s.name]).values())}
        }
        lazily = graph.node("y").slot  # declines `m` where `b` is not positive, by a rule that is asked in the run
        for slot in range(len(graph.names)):
            if slot in below:
                assert pinned.key(slot) not in plain.keys.by_slot[len(graph.inputs) :]
            elif slot != lazily:
                assert pinned.key(slot) == plain.key(slot)

    def test_as_an_input(self, graph: Graph) -> None:
        """The key is that of a graph input of the same type and value."""
        assert graph.request({"x": 2.5}, pinned={"a": 2.5}).key(graph.node("a").slot) == graph.request({"x": 2.5}).key(
            0
        )

    def test_back_again(self, graph: Graph) -> None:
        """Keys made for a pinned request serve no other one."""
        before = graph.request({"x": 1.0}).keys.by_slot
        graph.request({"x": 1.0}, pinned={"a": 1.0})
        assert graph.request({"x": 1.0}).keys.by_slot == before

    def test_threads(self, graph: Graph) -> None:
        """Threads that pin and do not pin the same graph on one evaluator each get their own results."""
        evaluator, wrong = Evaluator(memory=MemoryTier(), threads=2), []

        def work(value: float | None) -> None:
            for _ in range(50):
                pinned = {"a": value} if value is not None else {}
                result = evaluator.run(graph.request({"x": 1.0}, ["b"], pinned=pinned))["b"]
                if result != (value if value is not None else 2.0) + 2:
                    wrong.append(result)

        threads = [threading.Thread(target=work, args=(v,)) for v in (None, 2.0, 3.0, None)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert wrong == []


class TestRefused:
    @pytest.mark.parametrize(
        ("pinned", "said"),
        [
            ({"bb": 1.0}, "no node or input"),
            ({"x": 1.0}, "is an input of the graph"),
            ({"p.low": np.ones((2, 2))}, "name the whole node, 'p'"),
            ({"a": "text"}, "expected float"),
            ({"g": np.ones(3)}, "expected shape"),
            ({"g": "picture.png"}, "read from .npy"),
        ],
    )
    def test_before_anything_runs(self, graph: Graph, pinned: dict[str, object], said: str) -> None:
        """What is no node, or does not fit the type that the node gives, is refused with the request."""
        with pytest.raises(InputError, match=said):
            graph.request({"x": 1.0}, pinned=pinned)

    def test_no_file(self, graph: Graph, tmp_path: Path) -> None:
        """A file that is not there, or holds no array, is told as such."""
        with pytest.raises(UnreadableFile, match="No such file"):
            graph.request(pinned={"g": tmp_path / "a.npy"})
        (tmp_path / "b.npy").write_text("nothing")
        with pytest.raises(UnreadableFile):
            graph.request(pinned={"g": tmp_path / "b.npy"})


class TestFiles:
    def test_array(self, graph: Graph, tmp_path: Path) -> None:
        """An array whose type has no files of its own is read from .npy."""
        np.save(tmp_path / "a.npy", np.full((2, 2), 7.0))
        assert Evaluator().run(graph.request({}, ["m"], pinned={"g": tmp_path / "a.npy"}))["m"] == 7


class TestTold:
    def test_plan(self, graph: Graph) -> None:
        """The plan calls it pinned, with the value's origin, and says why nothing above runs."""
        fates = {p.name: p for p in plan(graph.request({}, ["b"], pinned={"b": 1.0}), Evaluator())}
        assert (fates["b"].fate, str(fates["b"].reason)) == ("pinned", "float stands in for it")
        assert (fates["a"].fate, str(fates["a"].reason)) == ("skipped", "only b needs it, and that is pinned")

    @pytest.mark.parametrize("disk", [True, False])
    def test_explain(self, graph: Graph, tmp_path: Path, disk: bool) -> None:
        """A run after another says that a node was pinned, and afterwards that it is no longer."""
        lab = HistoryLab(tmp_path, disk=disk)
        lab.run(graph, ["b"], x=1.0)
        asked = graph.request({}, ["b"], pinned={"a": 5.0})
        from graphface.report.explain import explain
        from graphface.report.history import Remember

        told = {e.name: str(e.reason) for e in explain(asked, lab.evaluator(), lab.history)}
        assert told["a"] == "float stands in for it"
        assert told["b"] == "a is pinned"
        lab.evaluator(Remember(lab.history, lab.disk)).run(asked)
        assert str(lab.before(graph, ["b"], x=2.0)["a"].reason) == "it is pinned no longer"


class TestChanged:
    def test_more_pins(self, graph: Graph) -> None:
        """A request is changed in one input or pinned node; the rest of it stays."""
        asked = changed(changed(graph.request({"x": 1.0}, ["b"]), "g", np.ones((2, 2))), "a", 5.0)
        assert set(asked.targets) == {"b"}
        assert {graph.names[slot] for slot in asked.pinned} == {"a", "g"}
        assert Evaluator().run(changed(graph.request({"x": 1.0}, ["b"]), "x", 4.0))["b"] == 7


class TestDumped:
    def test_record(self, graph: Graph, tmp_path: Path) -> None:
        """A value of any type is read from the file that a dump, or the debugger, wrote."""
        pair = graph.run(["p"], evaluator=Evaluator())["p"]
        write_value(pair, tmp_path / "p.npz")
        result = Evaluator().run(graph.request({}, ["p.low"], pinned={"p": tmp_path / "p.npz"}))
        np.testing.assert_array_equal(result["p.low"], pair.low)

    def test_another_type(self, graph: Graph, tmp_path: Path) -> None:
        """One of another type is refused."""
        write_value(1.5, tmp_path / "number.npz")
        with pytest.raises(UnreadableFile, match=r"number\.npz"):
            graph.request({}, ["p.low"], pinned={"p": tmp_path / "number.npz"})

    def test_no_file_for_it(self, graph: Graph, tmp_path: Path) -> None:
        """What can come from no other file is asked for as .npz."""
        with pytest.raises(InputError, match=r"is read from \.npz"):
            graph.request({}, ["p.low"], pinned={"p": "somewhere.png"})
