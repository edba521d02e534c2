"""A graph that loads can run: ports, types, parameters and order are all checked before."""

from collections.abc import Callable

import pytest

from graphface import DocumentError, Graph, Registry, load
from graphface.errors import Problem

Wired = Callable[..., Graph]


@pytest.fixture
def wired(registry: Registry) -> Wired:
    def make(nodes: str, **more: str) -> Graph:
        sections = "".join(f"{name}: {body}\n" for name, body in more.items())
        return load(f"graphface: 1\nnodes:\n{nodes}\n{sections}", registry=registry)

    return make


def refused(wired: Wired, nodes: str, **more: str) -> list[Problem]:
    with pytest.raises(DocumentError) as caught:
        wired(nodes, **more)
    return caught.value.problems


def only(wired: Wired, nodes: str, **more: str) -> Problem:
    (problem,) = refused(wired, nodes, **more)
    return problem


GRID = "  g: {use: toy.grid}\n"
NUMBER = "  n: {use: toy.number}\n"


class TestTypes:
    def test_both_ends(self, wired: Wired) -> None:
        """A wire that does not fit is refused at its place, with both ends and both types named."""
        problem = only(wired, GRID + "  x: {use: toy.add, in: {a: g}}")
        for part in ("g gives Grid", "'a'", "'x'", "toy.add", "takes float"):
            assert part in problem.message
        assert problem.place is not None
        assert (problem.place.line, problem.place.column) == (4, 29)

    @pytest.mark.parametrize(
        "nodes",
        [
            GRID + "  x: {use: toy.either, in: {value: g}}",
            NUMBER + "  x: {use: toy.either, in: {value: n}}",
            "  f: {use: toy.fine}\n  x: {use: toy.mean, in: {grid: f}}",
            "  c: {use: toy.circle}\n  x: {use: toy.name_of, in: {shape: c}}",
            GRID + "  x: {use: toy.takes_none, in: {grid: g}}",
            GRID + "  x: {use: toy.takes_none}",
            GRID + "  x: {use: toy.takes_none, in: {grid: null}}",
            GRID + "  p: {use: toy.pair, in: {grid: g}}\n  x: {use: toy.mean, in: {grid: p.low}}",
            NUMBER + "  x: {use: toy.total, in: {values: n}}",
            NUMBER + "  x: {use: toy.total, in: {values: [n, n]}}",
            GRID + "  x: {use: toy.same, in: {value: g}}",
        ],
        ids=["union", "union2", "array subtype", "subclass", "optional", "open", "none", "field", "one", "list", "any"],
    )
    def test_accepted(self, wired: Wired, nodes: str) -> None:
        """Unions, subtypes, optional ports, fields and lists take what they say."""
        assert "x" in {step.name for step in wired(nodes).steps}

    @pytest.mark.parametrize(
        ("nodes", "said"),
        [
            ("  s: {use: toy.options}\n  x: {use: toy.either, in: {value: s}}", "s gives str"),
            (GRID + "  x: {use: toy.fine}\n  y: {use: toy.radius_of, in: {circle: g}}", "g gives Grid"),
            (GRID + "  p: {use: toy.pair, in: {grid: g}}\n  x: {use: toy.mean, in: {grid: p.high}}", "may be None"),
            (
                GRID + "  p: {use: toy.maybe_pair, in: {grid: g}}\n  x: {use: toy.mean, in: {grid: p.low}}",
                "may be None",
            ),
            (GRID + NUMBER + "  x: {use: toy.total, in: {values: [n, g]}}", "g gives Grid"),
            (NUMBER + "  x: {use: toy.add, in: {a: [n]}}", "not a list"),
            (NUMBER + "  x: {use: toy.add, in: {a: [n, n]}}", "not a list"),
            (NUMBER + "  s: {use: toy.same, in: {value: n}}\n  x: {use: toy.add, in: {a: s}}", "s gives Any"),
        ],
    )
    def test_refused(self, wired: Wired, nodes: str, said: str) -> None:
        """What may not fit does not load."""
        assert said in only(wired, nodes).message

    def test_supertype_is_not_enough(self, wired: Wired, registry: Registry) -> None:
        """A port that wants the finer type does not take the coarser one."""
        text = "{s: Shape}"
        problem = only(wired, "  x: {use: toy.radius_of, in: {circle: s}}", inputs=text)
        assert "s gives Shape" in problem.message

    def test_field_of_a_union(self, registry: Registry) -> None:
        """A field is there only where every alternative has it."""
        text = "graphface: 1\ninputs: {v: Pair | float}\nnodes:\n  x: {use: toy.mean, in: {grid: v.low}}\n"
        with pytest.raises(DocumentError, match="'low'"):
            load(text, registry=registry)


class TestNames:
    def test_unknown_operator(self, wired: Wired) -> None:
        """An unknown operator is told the nearest, at its place."""
        problem = only(wired, "  x: {use: toy.nmber}")
        assert problem.nearest[0] == "toy.number"
        assert problem.place is not None
        assert problem.place.column == 12

    def test_right_name_wrong_family(self, wired: Wired) -> None:
        """The right name with the wrong prefix is recognized."""
        assert "toy.number" in only(wired, "  x: {use: tools.number}").nearest

    def test_unknown_operator_each_time(self, wired: Wired) -> None:
        """It is told at every node that uses it."""
        found = refused(wired, "  x: {use: toy.nmber}\n  y: {use: toy.nmber}")
        assert [p.place.line for p in found if p.place] == [3, 4]

    def test_unknown_port(self, wired: Wired) -> None:
        """An unknown port is told those there are and the nearest."""
        problem = only(wired, GRID + "  x: {use: toy.mean, in: {grid: g, gird: g}}")
        assert problem.nearest == ("grid",)

    def test_port_under_with(self, wired: Wired) -> None:
        """A port set like a parameter is told where it belongs."""
        assert "under 'in'" in only(wired, NUMBER + "  x: {use: toy.add, in: {a: n}, with: {b: 3}}").message

    def test_parameter_under_in(self, wired: Wired) -> None:
        """And the other way round."""
        assert "under 'with'" in only(wired, NUMBER + "  x: {use: toy.add, in: {a: n, plus: n}}").message

    def test_missing_port(self, wired: Wired) -> None:
        """A required port left open is named with its type."""
        problem = only(wired, "  x: {use: toy.mean}")
        assert "'grid' (Grid)" in problem.message

    def test_unknown_field(self, wired: Wired) -> None:
        """An unknown field of an output is told the nearest."""
        problem = only(wired, GRID + "  p: {use: toy.pair, in: {grid: g}}\n  x: {use: toy.mean, in: {grid: p.lwo}}")
        assert problem.nearest == ("low",)

    def test_unknown_reference(self, wired: Wired) -> None:
        """A wire from nowhere is told the nearest node or input."""
        problem = only(wired, GRID + "  x: {use: toy.mean, in: {grid: gg}}")
        assert problem.nearest == ("g",)

    @pytest.mark.parametrize("name", ["Gird", "list[Gird]", "Gird | None"])
    def test_unknown_type(self, wired: Wired, name: str) -> None:
        """An unknown type of an input is told the nearest."""
        assert only(wired, GRID, inputs=f"{{i: '{name}'}}").nearest[0] == "Grid"

    @pytest.mark.parametrize("name", ["", "|", "list[", "None", "list[]", "list[" * 3000 + "]" * 3000, "Grid |"])
    def test_no_type_at_all(self, wired: Wired, name: str) -> None:
        """A text that is no type is an unknown type."""
        assert "unknown type" in only(wired, GRID, inputs=f"{{i: '{name}'}}").message

    def test_bar_inside_a_list(self, wired: Wired) -> None:
        """A list may be of alternatives."""
        graph = wired("  x: {use: toy.same, in: {value: i}}", inputs="{i: 'list[Grid | float] | None'}")
        assert str(graph.inputs["i"].type) == "list[Grid | float] | None"

    def test_output_of_nowhere(self, wired: Wired) -> None:
        """An output from nowhere is told the nearest."""
        assert only(wired, GRID, outputs="{y: gg}").nearest == ("g",)


class TestParameters:
    RANGED = NUMBER + "  x: {use: toy.ranged, in: {a: n}, with: {%s}}"

    @pytest.mark.parametrize(
        ("settings", "parameter"),
        [
            ("must: 1, count: 0", "count"),
            ("must: 1, count: 9", "count"),
            ("must: 1, count: 2.5", "count"),
            ("must: 1, count: many", "count"),
            ("must: 1, count: null", "count"),
            ("must: 1, mode: 3", "mode"),
            ("must: .nan", "must"),
            ("must: .inf", "must"),
            ("must: 1e999", "must"),
            ("must: [1]", "must"),
            ("must: 1, count: " + "9" * 900, "count"),
            ("must: 1, count: " + "9" * 9000, "count"),
            ("must: 1, count: 0x" + "f" * 90000, "count"),
        ],
    )
    def test_wrong(self, wired: Wired, settings: str, parameter: str) -> None:
        """A value of the wrong type or out of range is refused at its place, in one short line."""
        problem = only(wired, self.RANGED % settings)
        assert repr(parameter) in problem.message
        assert len(problem.message) < 300
        assert problem.place is not None
        assert problem.place.line == 4
        assert problem.place.column == 43 + settings.index(parameter)

    def test_huge_float(self, wired: Wired) -> None:
        """An integer too large for a float is refused, not an overflow."""
        assert "'must'" in only(wired, self.RANGED % ("must: " + "9" * 400)).message

    def test_missing(self, wired: Wired) -> None:
        """A required parameter left out is named at its node, at every such node."""
        found = refused(wired, NUMBER + "  x: {use: toy.ranged, in: {a: n}}\n  y: {use: toy.ranged, in: {a: n}}")
        assert [p.place.line for p in found if p.place] == [4, 5]
        assert all("'must'" in p.message for p in found)

    def test_unknown(self, wired: Wired) -> None:
        """An unknown parameter is told the nearest."""
        assert only(wired, NUMBER + "  x: {use: toy.add, in: {a: n}, with: {pluss: 1}}").nearest == ("plus",)

    def test_number_as_text(self, wired: Wired) -> None:
        """A number is a number however it is written."""
        graph = wired(self.RANGED % "must: 1e0, count: 2.0")
        assert next(s for s in graph.steps if s.name == "x").parameters == {"count": 2, "mode": "plain", "must": 1.0}

    def test_inside_a_value(self, wired: Wired) -> None:
        """Of a mapping or list, the wrong value in it is shown."""
        problem = only(wired, "  x: {use: toy.options, with: {items: 3}}")
        assert problem.message == "parameter 'items' of node 'x' (toy.options): input should be a list, got 3"
        assert problem.place is not None
        assert problem.place.column == 32
        problem = only(wired, "  x: {use: toy.nested, with: {sizes: {a: [1, 2], b: [3, x]}}}")
        assert problem.message == (
            "parameter 'sizes'['b'][1] of node 'x' (toy.nested): input should be a whole number, got 'x'"
        )
        assert problem.place is not None
        assert problem.place.column == 57

    def test_choice(self, wired: Wired) -> None:
        """A word that is none of the choices is told the nearest."""
        assert only(wired, "  x: {use: toy.nested, with: {mode: sfot}}").nearest == ("soft",)

    def test_deep_value(self, wired: Wired) -> None:
        """A parameter may be a structure, to the depth that files may have."""
        graph = wired("  x: {use: toy.options, with: {anything: " + "[" * 58 + "1" + "]" * 58 + "}}")
        assert graph.run(outputs=["x"])["x"] == "options"


class TestOrder:
    def test_written_in_any_order(self, wired: Wired) -> None:
        """Nodes may be written in any order; steps stand after what they depend on."""
        graph = wired("  z: {use: toy.add, in: {a: y}}\n  y: {use: toy.add, in: {a: x}}\n  x: {use: toy.number}")
        assert [step.name for step in graph.steps] == ["x", "y", "z"]

    def test_cycle(self, wired: Wired) -> None:
        """A cycle is told as a path, at its first node."""
        problem = only(
            wired,
            NUMBER
            + "  a: {use: toy.add, in: {a: c}}\n  b: {use: toy.add, in: {a: a, b: n}}\n  c: {use: toy.add, in: {a: b}}",
        )
        assert "a -> b -> c -> a" in problem.message
        assert problem.place is not None
        assert problem.place.line == 4

    def test_self(self, wired: Wired) -> None:
        """A node cannot need itself."""
        assert "a -> a" in only(wired, "  a: {use: toy.add, in: {a: a}}").message

    def test_lazy_cycle(self, wired: Wired) -> None:
        """A lazy port closes a cycle like any other."""
        assert "g -> g" in only(wired, NUMBER + "  g: {use: toy.gate, in: {a: n, extra: g}}").message
