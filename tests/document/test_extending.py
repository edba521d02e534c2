"""`extends`: a file laid over the one that it starts from."""

from collections.abc import Callable
from pathlib import Path

from graph_texts import ADD, refused

from graphface import Graph

Write = Callable[..., Path]


class TestExtends:
    def test_base_shines_through(self, write: Write, opened: Callable[..., Graph]) -> None:
        """What a file does not say is as its base says."""
        write("base.yaml", "doc: Base.\n" + ADD)
        graph = opened(write("g.yaml", "extends: base.yaml\nnodes: {x: {with: {plus: 5}}}\n"))
        assert dict(graph.run()) == {"y": 6}
        assert graph.composition.doc == "Base."

    def test_chain(self, write: Write, opened: Callable[..., Graph]) -> None:
        """A base may have a base."""
        write("a.yaml", ADD)
        write("b.yaml", "extends: a.yaml\nnodes: {n: {with: {value: 10}}, x: {with: {plus: 2}}}\n")
        assert opened(write("c.yaml", "extends: b.yaml\nnodes: {x: {with: {plus: 3}}}\n")).run()["y"] == 13

    def test_removal(self, write: Write, opened: Callable[..., Graph]) -> None:
        """`node: null` takes a node of the base away."""
        write("base.yaml", ADD)
        graph = opened(write("g.yaml", "extends: base.yaml\nnodes: {x: null}\noutputs: {y: n}\n"))
        assert [s.name for s in graph.steps] == ["n"]

    def test_removed_and_stated_again(self, write: Write, opened: Callable[..., Graph]) -> None:
        """A node that a base removed comes back where a file says what it is."""
        write("a.yaml", ADD)
        write("b.yaml", "extends: a.yaml\nnodes: {x: null}\noutputs: {y: n}\n")
        text = "extends: b.yaml\nnodes: {x: {use: toy.add, in: {a: n}, with: {plus: 7}}}\noutputs: {y: x}\n"
        assert opened(write("c.yaml", text)).run()["y"] == 8

    def test_other_operator(self, write: Write, opened: Callable[..., Graph]) -> None:
        """Parameters written for an operator that a file exchanges are dropped if the new one has none such."""
        write("base.yaml", ADD)
        graph = opened(write("g.yaml", "extends: base.yaml\nnodes: {x: {use: toy.subtract}}\n"))
        assert graph.run()["y"] == 1

    def test_names_are_of_the_file_that_says_them(self, write: Write, opened: Callable[..., Graph]) -> None:
        """A file named by a base is looked for beside the base."""
        write("bases/inner.yaml", ADD)
        write("bases/base.yaml", "nodes: {i: {use: inner.yaml}}\noutputs: {y: i}\n")
        assert opened(write("g.yaml", "extends: bases/base.yaml\n")).run()["y"] == 2

    def test_itself(self, write: Write, opened: Callable[..., Graph]) -> None:
        """A file that extends itself, also by way of another, is refused."""
        write("b.yaml", "extends: a.yaml\n")
        (problem,) = refused(opened, write("a.yaml", "extends: b.yaml\n"))
        assert "extends itself" in problem.message

    def test_missing(self, write: Write, opened: Callable[..., Graph]) -> None:
        """A base that does not exist is told with the nearest name."""
        write("base.yaml", ADD)
        problem, *_ = refused(opened, write("g.yaml", "extends: bas.yaml\n"))
        assert problem.nearest[0] == "base.yaml"
        assert problem.place is not None
        assert (problem.place.line, problem.place.column) == (2, 10)
