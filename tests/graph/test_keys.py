"""A key is known before anything runs, and changes exactly when the value could."""

from collections.abc import Callable
from typing import Annotated

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface import Cosmetic, Evaluator, Graph, MemoryTier, Registry, load, node

Load = Callable[..., Graph]


@pytest.fixture
def loaded(registry: Registry) -> Load:
    def make(nodes: str, inputs: str = "{}") -> Graph:
        return load(f"graphface: 1\ninputs: {inputs}\nnodes:\n{nodes}\n", registry=registry)

    return make


def key(graph: Graph, name: str = "x", **inputs: object) -> bytes:
    asked = graph.request(inputs, [name])
    return asked.key(asked.targets[name].slot)


NUMBER = "  n: {use: toy.number}\n"


class TestParameters:
    @pytest.mark.parametrize("text", ["1", "1.0", "1e0", "+1", "0x1", "10e-1"])
    def test_spelling(self, loaded: Load, text: str) -> None:
        """One number is one key however it is written."""
        graph = loaded(f"  x: {{use: toy.number, with: {{value: {text}}}}}")
        assert key(graph) == key(loaded("  x: {use: toy.number, with: {value: 1}}"))

    def test_default(self, loaded: Load) -> None:
        """A parameter written out at its default is the default."""
        assert key(loaded("  x: {use: toy.number, with: {value: 1}}")) == key(loaded("  x: {use: toy.number}"))

    def test_negative_zero(self, loaded: Load) -> None:
        """0 and -0.0 are one number."""
        texts = ("  x: {use: toy.number, with: {value: 0}}", "  x: {use: toy.number, with: {value: -0.0}}")
        assert key(loaded(texts[0])) == key(loaded(texts[1]))

    def test_value(self, loaded: Load) -> None:
        """Another value is another key."""
        assert key(loaded("  x: {use: toy.number, with: {value: 2}}")) != key(loaded("  x: {use: toy.number}"))

    @given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6))
    def test_equal_keys_equal_values(self, one: float, other: float) -> None:
        """Two numbers have one key if and only if they are equal."""
        from toys import toy_registry

        registry = toy_registry()
        keys = [
            key(load({"graphface": 1, "nodes": {"x": {"use": "toy.number", "with": {"value": v}}}}, registry=registry))
            for v in (one, other)
        ]
        assert (keys[0] == keys[1]) == (one == other)

    def test_cosmetic(self, loaded: Load) -> None:
        """A parameter marked cosmetic is in no key."""
        assert key(loaded("  x: {use: toy.number, with: {label: other}}")) == key(loaded("  x: {use: toy.number}"))

    def test_text_is_no_number(self, loaded: Load) -> None:
        """The text "1" is not the number 1."""
        texts = ("  x: {use: toy.options, with: {anything: '1'}}", "  x: {use: toy.options, with: {anything: 1}}")
        assert key(loaded(texts[0])) != key(loaded(texts[1]))

    def test_order_of_a_table(self, loaded: Load) -> None:
        """The order of a mapping does not count, that of a list does."""
        table = "  x: {use: toy.options, with: {table: {%s}}}"
        assert key(loaded(table % "a: 1, b: 2")) == key(loaded(table % "b: 2, a: 1"))
        items = "  x: {use: toy.options, with: {items: [%s]}}"
        assert key(loaded(items % "1, 2")) != key(loaded(items % "2, 1"))


class TestWires:
    def test_order_of_ports(self, loaded: Load) -> None:
        """The order in which ports are written does not count."""
        nodes = NUMBER + "  m: {use: toy.number, with: {value: 2}}\n"
        one = loaded(nodes + "  x: {use: toy.add, in: {a: n, b: m}}")
        assert key(one) == key(loaded(nodes + "  x: {use: toy.add, in: {b: m, a: n}}"))

    def test_exchanged_ports(self, loaded: Load) -> None:
        """Which value goes into which port does."""
        nodes = NUMBER + "  m: {use: toy.number, with: {value: 2}}\n"
        one = loaded(nodes + "  x: {use: toy.add, in: {a: n, b: m}}")
        assert key(one) != key(loaded(nodes + "  x: {use: toy.add, in: {a: m, b: n}}"))

    def test_names(self, loaded: Load) -> None:
        """What nodes are called does not count."""
        assert key(loaded(NUMBER + "  x: {use: toy.add, in: {a: n}}")) == key(
            loaded("  other: {use: toy.number}\n  x: {use: toy.add, in: {a: other}}")
        )

    def test_field(self, loaded: Load) -> None:
        """Which field of a value is taken counts."""
        nodes = (
            "  g: {use: toy.grid}\n  p: {use: toy.pair, in: {grid: g}}\n  x: {use: toy.takes_none, in: {grid: p.%s}}"
        )
        assert key(loaded(nodes % "low")) != key(loaded(nodes % "high"))

    def test_list_of_one(self, loaded: Load) -> None:
        """One wire into a list port is a list of one, written either way."""
        assert key(loaded(NUMBER + "  x: {use: toy.total, in: {values: n}}")) == key(
            loaded(NUMBER + "  x: {use: toy.total, in: {values: [n]}}")
        )

    def test_grouping_of_lists(self, loaded: Load) -> None:
        """Repeated and reordered wires of a list port are other values."""
        nodes = NUMBER + "  m: {use: toy.number, with: {value: 2}}\n  x: {use: toy.total, in: {values: [%s]}}"
        keys = {key(loaded(nodes % wires)) for wires in ("n, m", "m, n", "n", "n, n", "n, m, m", "")}
        assert len(keys) == 6

    def test_upstream(self, loaded: Load) -> None:
        """A change far above changes every key below, and none beside."""
        chain = (
            "  n: {use: toy.number, with: {value: %d}}\n  m: {use: toy.add, in: {a: n}}\n"
            "  x: {use: toy.add, in: {a: m}}\n"
        )
        beside = "  y: {use: toy.grid}"
        one, other = loaded(chain % 1 + beside), loaded(chain % 2 + beside)
        assert key(one) != key(other)
        assert key(one, "y") == key(other, "y")

    def test_length(self, loaded: Load) -> None:
        """A key has one size at any depth."""
        nodes = NUMBER + "\n".join(
            f"  k{i}: {{use: toy.add, in: {{a: {f'k{i - 1}' if i else 'n'}}}}}" for i in range(200)
        )
        assert {len(k) for k in loaded(nodes).request().keys.by_slot} == {16}


class TestInputs:
    SAME = "  x: {use: toy.same, in: {value: i}}"

    def test_content(self, loaded: Load) -> None:
        """Equal arrays have one key, however they lie in memory."""
        graph, grid = loaded(self.SAME, "{i: Any}"), np.arange(12.0).reshape(3, 4)
        assert key(graph, i=grid) == key(graph, i=np.asfortranarray(grid))
        assert key(graph, i=grid) == key(graph, i=np.repeat(grid, 2, axis=1)[:, ::2])

    @pytest.mark.parametrize(
        "other",
        [
            np.zeros((2, 6)),
            np.zeros(12),
            np.zeros((3, 4), np.int64),
            np.zeros((3, 4), ">f8"),
            np.zeros((3, 8), np.float32),
        ],
    )
    def test_same_bytes(self, loaded: Load, other: np.ndarray) -> None:
        """The same bytes with another shape or dtype are another input."""
        graph = loaded(self.SAME, "{i: Any}")
        assert key(graph, i=np.zeros((3, 4))) != key(graph, i=other)

    def test_nan_hits(self, loaded: Load) -> None:
        """An array that holds NaN is found again."""
        graph = loaded("  x: {use: toy.takes_none, in: {grid: i}}", "{i: Grid}")
        evaluator = Evaluator(memory=MemoryTier(), guard="off")
        states = [graph.run(["x"], evaluator=evaluator, i=np.full((2, 2), np.nan)).records[-1].state for _ in range(2)]
        assert states == ["ran", "memory"]

    def test_back_and_forth(self, loaded: Load) -> None:
        """A graph given one input, another and the first again has the first's keys again."""
        graph = loaded(self.SAME, "{i: Any}")
        first, second, third = (graph.request({"i": i}).keys.by_slot for i in (1, 2, 1))
        assert first == third != second

    def test_never_written_to(self, loaded: Load) -> None:
        """Keys from which others are made stay as they were: another thread may be running by them."""
        graph = loaded("  x: {use: toy.positive, in: {a: i, extra: i}}", "{i: float}")
        first = graph.request({"i": -1.0})
        before, declined = list(first.keys.by_slot), dict(first.keys.declined)
        graph.request({"i": 5.0})
        assert (list(first.keys.by_slot), dict(first.keys.declined)) == (before, declined)

    def test_from_earlier_ones(self, loaded: Load) -> None:
        """Keys made from earlier ones are those made from nothing, decisions included."""
        text = "  x: {use: toy.positive, in: {a: i, extra: j}}"
        graph = loaded(text, "{i: float, j: float}")
        for i, j in ((-1.0, 1.0), (5.0, 1.0), (5.0, 2.0), (-1.0, 2.0), (-1.0, 1.0)):
            found = graph.request({"i": i, "j": j}).keys
            afresh = loaded(text, "{i: float, j: float}").request({"i": i, "j": j}).keys
            assert (found.by_slot, found.declined) == (afresh.by_slot, afresh.declined)


class TestCode:
    def make(self, plus: int, version: int = 1, needs: object = None) -> Graph:
        registry = Registry()
        scope: dict[str, object] = {"node": node, "version": version}
        exec(f"def grown(a: float = 1.0) -> float:\n    return a + {plus}\n", scope)
        registry.add(node("mine.grown", version=version)(scope["grown"]))  # type: ignore[type-var]
        return load("graphface: 1\nnodes: {x: {use: mine.grown}}\n", registry=registry)

    def test_same_code(self) -> None:
        """The same function defined again is the same operator."""
        assert key(self.make(1)) == key(self.make(1))

    def test_edited(self) -> None:
        """An edited body is another one."""
        assert key(self.make(1)) != key(self.make(2))

    def test_version(self) -> None:
        """So is a raised version."""
        assert key(self.make(1)) != key(self.make(1, version=2))

    def test_helper_replaced_while_running(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """A helper replaced while the process runs changes the keys of a graph already loaded."""
        registry = Registry()
        registry.add(uses_helper)
        graph = load("graphface: 1\nnodes: {x: {use: mine.helped}}\n", registry=registry)
        evaluator = Evaluator(memory=MemoryTier())
        before = key(graph)
        assert graph.run(["x"], evaluator=evaluator)["x"] == 1
        monkeypatch.setitem(globals(), "helper", lambda: 2.0)
        assert key(graph) != before
        assert graph.run(["x"], evaluator=evaluator)["x"] == 2


def helper() -> float:
    return 1.0


@node("mine.helped")
def uses_helper(*, label: Annotated[str, Cosmetic] = "") -> float:
    return helper()
