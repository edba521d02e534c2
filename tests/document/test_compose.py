"""Many files and flags make one graph; who wins is a table, and every name that means nothing is answered."""

from collections.abc import Callable
from pathlib import Path

import pytest

from graphface import DocumentError, Graph
from graphface.document import compose
from graphface.errors import Problem

Write = Callable[..., Path]


def refused(opened: Callable[..., Graph], path: object, **choices: object) -> list[Problem]:
    with pytest.raises(DocumentError) as caught:
        opened(path, **choices)
    return caught.value.problems


def setting(graph: Graph, node: str, parameter: str = "plus") -> object:
    return next(step for step in graph.steps if step.name == node).parameters[parameter]


class TestNesting:
    INNER = """
inputs: {a: float, b: {type: float, default: 100}}
nodes: {sum: {use: toy.add, in: {a: a, b: b}, with: {plus: 1}}}
outputs: {total: sum}
"""
    MIDDLE = "inputs: {v: float}\nnodes: {in: {use: inner.yaml, in: {a: v}}}\noutputs: {out: in.total}\n"
    OUTER = "nodes:\n  n: {use: toy.number, with: {value: 5}}\n  m: {use: middle.yaml, in: {v: n}}\noutputs: {y: m}\n"

    @pytest.fixture
    def outer(self, write: Write) -> Path:
        write("inner.yaml", self.INNER)
        write("middle.yaml", self.MIDDLE)
        return write("outer.yaml", self.OUTER)

    def test_two_deep(self, outer: Path, opened: Callable[..., Graph]) -> None:
        """A graph used as a node may itself use one; its nodes are named by their path."""
        graph = opened(outer)
        assert [s.name for s in graph.steps] == ["n", "m/in/sum"]
        assert graph.run()["y"] == 106

    def test_open_input_is_an_input_of_the_whole(self, outer: Path, opened: Callable[..., Graph]) -> None:
        """An inner input left at its default can be given by its path."""
        assert opened(outer).run(**{"m/in/b": 3.0})["y"] == 9

    def test_intermediate(self, outer: Path, opened: Callable[..., Graph]) -> None:
        """Any inner node can be asked for."""
        assert opened(outer).run(outputs=["m/in/sum"])["m/in/sum"] == 106

    def test_set_inner_parameter(self, outer: Path, opened: Callable[..., Graph]) -> None:
        """A flag reaches any depth."""
        assert opened(outer, set={"m/in/sum.plus": 50}).run()["y"] == 155

    def test_constant_for_an_input(self, write: Write, outer: Path, opened: Callable[..., Graph]) -> None:
        """`with` of a graph node sets its inputs, and parameters inside it by path."""
        text = "nodes: {i: {use: inner.yaml, with: {a: 1, b: 2, sum.plus: 4}}}\noutputs: {y: i}\n"
        assert opened(write("g.yaml", text)).run()["y"] == 7

    def test_used_twice(self, write: Write, outer: Path, opened: Callable[..., Graph]) -> None:
        """A graph may be used more than once, each with its own settings."""
        text = (
            "nodes:\n  p: {use: inner.yaml, with: {a: 1, sum.plus: 10}}\n  q: {use: inner.yaml, in: {a: p}}\n"
            "outputs: {y: q}\n"
        )
        assert opened(write("g.yaml", text)).run()["y"] == 212

    def test_inner_node_as_reference(self, write: Write, outer: Path, opened: Callable[..., Graph]) -> None:
        """A wire may lead to a node inside a used graph."""
        text = (
            "nodes:\n  n: {use: toy.number}\n  m: {use: middle.yaml, in: {v: n}}\n"
            "  x: {use: toy.add, in: {a: m/in/sum}}\n"
        )
        assert opened(write("g.yaml", text)).run(outputs=["x"])["x"] == 102

    def test_itself(self, write: Write, opened: Callable[..., Graph]) -> None:
        """A graph that uses itself, also by way of another, is refused."""
        write("b.yaml", "nodes: {x: {use: a.yaml}}\n")
        (problem,) = refused(opened, write("a.yaml", "nodes: {x: {use: b.yaml}}\n"))
        assert "uses itself" in problem.message

    def test_open_input(self, write: Write, outer: Path, opened: Callable[..., Graph]) -> None:
        """An inner input without default has to be connected; unplugging it is not connecting it."""
        for wires in ("", ", in: {a: null}"):
            (problem,) = refused(opened, write("g.yaml", f"nodes: {{i: {{use: inner.yaml{wires}}}}}\n"))
            assert "'a'" in problem.message

    def test_optional_input(self, write: Write, opened: Callable[..., Graph]) -> None:
        """An inner input that may be None may stay open."""
        write(
            "opt.yaml", "inputs: {g: Grid | None}\nnodes: {s: {use: toy.takes_none, in: {grid: g}}}\noutputs: {y: s}\n"
        )
        assert opened(write("g.yaml", "nodes: {i: {use: opt.yaml}}\noutputs: {y: i}\n")).run()["y"] == -1

    def test_connected_and_set(self, write: Write, outer: Path, opened: Callable[..., Graph]) -> None:
        """An input cannot be connected and set: neither silently wins."""
        text = "nodes:\n  n: {use: toy.number}\n  i: {use: inner.yaml, in: {a: n}, with: {a: 3}}\n"
        (problem,) = refused(opened, write("g.yaml", text))
        assert "connected" in problem.message

    def test_unknown_input(self, write: Write, outer: Path, opened: Callable[..., Graph]) -> None:
        """A wire into an input that a graph does not have is told the nearest."""
        write("lights.yaml", "inputs: {lamp: float}\nnodes: {x: {use: toy.add, in: {a: lamp}}}\n")
        text = "nodes:\n  n: {use: toy.number}\n  i: {use: lights.yaml, in: {lam: n, lamp: n}}\n"
        (problem,) = refused(opened, write("g.yaml", text))
        assert problem.nearest == ("lamp",)

    def test_unknown_output(self, write: Write, outer: Path, opened: Callable[..., Graph]) -> None:
        """So is an output that a graph does not have."""
        (problem,) = refused(
            opened, write("g.yaml", "nodes: {m: {use: inner.yaml, with: {a: 1}}}\noutputs: {y: m.totl}\n")
        )
        assert problem.nearest == ("total",)

    def test_several_outputs(self, write: Write, opened: Callable[..., Graph]) -> None:
        """Of a graph with several outputs one has to be named."""
        write("two.yaml", "nodes: {a: {use: toy.number}}\noutputs: {p: a, q: a}\n")
        (problem,) = refused(opened, write("g.yaml", "nodes: {t: {use: two.yaml}}\noutputs: {y: t}\n"))
        assert "p, q" in problem.message

    def test_loop_through_graphs(self, write: Write, opened: Callable[..., Graph]) -> None:
        """A reference that leads back to itself ends."""
        write("pass.yaml", "inputs: {x: Any}\noutputs: {y: x}\n")
        text = "nodes:\n  a: {use: pass.yaml, in: {x: b}}\n  b: {use: pass.yaml, in: {x: a}}\noutputs: {y: a}\n"
        problem, *_ = refused(opened, write("g.yaml", text))
        assert "back to itself" in problem.message

    def test_doubling_lists(self, write: Write, opened: Callable[..., Graph]) -> None:
        """Lists that double at every step are refused instead of filling the memory."""
        write("pass.yaml", "inputs: {x: 'list[Any]'}\noutputs: {y: x}\n")
        nodes = ["  n: {use: toy.number}", "  g0: {use: pass.yaml, in: {x: [n, n]}}"]
        nodes += [f"  g{i}: {{use: pass.yaml, in: {{x: [g{i - 1}, g{i - 1}]}}}}" for i in range(1, 40)]
        nodes += ["  t: {use: toy.total, in: {values: g39}}"]
        (problem,) = refused(opened, write("g.yaml", "nodes:\n" + "\n".join(nodes) + "\n"))
        assert "wires" in problem.message

    def test_multiplying_graphs(
        self, write: Write, opened: Callable[..., Graph], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """Small files that multiply to endless nodes, or to endless graphs without nodes, are refused."""
        monkeypatch.setattr("graphface.document.compose.MAX_NODES", 1000)
        write("g0.yaml", "")
        for i in range(1, 8):
            write(f"g{i}.yaml", "nodes:\n" + "".join(f"  x{k}: {{use: g{i - 1}.yaml}}\n" for k in range(10)))
        (problem,) = refused(opened, write("g.yaml", "nodes: {x: {use: g7.yaml}}\n"))
        assert problem.message == "more than 1,000 nodes; graphs used in graphs multiply"

    def test_the_limit_is_soon_reached(self) -> None:
        """A few seconds and megabytes of somebody else's file, not a minute and a gigabyte."""
        assert compose.MAX_NODES <= 200_000


class TestPrecedence:
    """The order of the module's docstring, weakest first; in each row the later of two wins."""

    BASE = "nodes: {sum: {use: toy.add, in: {a: a}, with: {plus: 2}}}\ninputs: {a: {type: float, default: 0}}\n"
    FILE = (
        "extends: base.yaml\nnodes: {sum: {with: {plus: 3}}}\noutputs: {y: sum}\n"
        "variants: {v: {sum: {with: {plus: 5}}}}\nprofiles: {p: {sum: {plus: 7}}}\n"
    )
    USER = (
        "nodes: {i: {use: file.yaml%s}}\noutputs: {y: i}\n"
        "variants: {v: {}, w: {i/sum: {with: {plus: 6}}}, wd: {i: {with: {sum.plus: 6}}}}\n"
        "profiles: {p: {}, q: {i/sum: {plus: 8}}, qd: {i: {sum.plus: 8}}}\n"
    )
    WITH = ", with: {sum.plus: 4}"

    @pytest.mark.parametrize(
        ("body", "choices", "expected"),
        [
            ("", {}, 3),  # the file over its base (2) and over the operator's default (0)
            (WITH, {}, 4),  # the enclosing graph's `with` over the file
            (WITH, {"variants": ["v"]}, 5),  # a variant over `with`
            (WITH, {"variants": ["v", "w"]}, 6),  # the user's variant over the used file's
            (WITH, {"variants": ["w", "v"]}, 6),  # also where it was asked for first
            (WITH, {"variants": ["v", "wd"]}, 6),  # also written as "node.parameter"
            (WITH, {"variants": ["v", "w"], "profiles": ["p"]}, 7),  # profiles over variants
            (WITH, {"variants": ["v", "wd"], "profiles": ["p"]}, 7),
            (WITH, {"variants": ["v"], "profiles": ["p", "q"]}, 8),  # the user's profile over the used file's
            (WITH, {"variants": ["v"], "profiles": ["p", "qd"]}, 8),
            (WITH, {"variants": ["v"], "profiles": ["p", "q"], "set": {"i/sum.plus": 9}}, 9),  # `--set` over all
            (WITH, {"replace": {"i/sum": "toy.add"}}, 4),  # the same operator again changes nothing
        ],
    )
    def test_order(
        self, write: Write, opened: Callable[..., Graph], body: str, choices: dict[str, object], expected: float
    ) -> None:
        """One order decides."""
        write("base.yaml", self.BASE)
        write("file.yaml", self.FILE)
        graph = opened(write("user.yaml", self.USER % body), **choices)
        assert setting(graph, "i/sum") == expected
        assert graph.run()["y"] == expected

    def test_default(self, write: Write, opened: Callable[..., Graph]) -> None:
        """What nobody sets is the operator's default."""
        assert setting(opened(write("g.yaml", "nodes: {x: {use: toy.number}}\n")), "x", "value") == 1


class TestAllAtOnce:
    def test_files_and_names_and_types(self, write: Write, opened: Callable[..., Graph]) -> None:
        """Unknown files, references, operators, parameters and nodes of flags are told together."""
        text = (
            "nodes:\n  a: {use: toy.nmber}\n  b: {use: none.yaml}\n  c: {use: toy.add, in: {a: nothing}}\n"
            "  d: {use: toy.number, with: {valu: 3}}\n  e: {in: {a: d}}\noutputs: {y: nope}\n"
        )
        found = refused(opened, write("g.yaml", text), set={"zz.q": 1})
        lines = sorted(p.place.line for p in found if p.place is not None and p.place.source.name != "--set")
        assert lines == [3, 4, 5, 6, 7, 8]
        assert sum(p.place is not None and p.place.source.name == "--set" for p in found) == 1
