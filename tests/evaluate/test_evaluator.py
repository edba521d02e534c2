"""What a run promises: run / memoized / declined / failed, the same under every cache tier and every executor."""

from pathlib import Path

import numpy as np
import pytest
from evaluator_lab import Lab, build

from graphface import Registry, RunFailed
from graphface.errors import NonFiniteError

DIAMOND = """
    source: {use: toy.number, with: {value: 3, label: source}}
    left: {use: toy.add, in: {a: source}, with: {plus: 1, label: left}}
    right: {use: toy.add, in: {a: source}, with: {plus: 2, label: right}}
    join: {use: toy.add, in: {a: left, b: right}, with: {label: join}}
    aside: {use: toy.add, in: {a: source}, with: {plus: 9, label: aside}}
"""


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
