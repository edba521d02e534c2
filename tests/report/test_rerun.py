"""One line says how much of a graph ran and what made it run."""

import contextlib

import pytest
from toys import toy_registry

from graphface import Evaluator, Graph, MemoryTier, RunFailed, load
from graphface.report.history import History, Remember
from graphface.report.rerun import Rerun

TEXT = """graphface: 1
name: again
inputs: {x: {type: float, default: 1}}
nodes:
  a: {use: toy.add, in: {a: x}, with: {plus: 1}}
  b: {use: toy.add, in: {a: a}, with: {plus: 2}}
  c: {use: toy.add, in: {a: b}, with: {plus: 3}}
  d: {use: toy.add, in: {a: c, b: a}, with: {plus: 4}}
  bad: {use: toy.fail, in: {a: d}}
outputs: {d: d}
"""


class Session:
    def __init__(self) -> None:
        self.evaluator, self.history = Evaluator(memory=MemoryTier()), History()

    def line(
        self, graph: Graph, outputs: list[str] | None = None, pinned: dict[str, float] | None = None, **x: float
    ) -> str:
        rerun = Rerun(self.evaluator, self.history)
        with contextlib.suppress(RunFailed):
            self.evaluator.run(graph.request(x, outputs, pinned=pinned), [rerun, Remember(self.history, None)])
        return rerun.line


def graph(**sets: float) -> Graph:
    return load(TEXT, registry=toy_registry(), set={name.replace("_", "."): value for name, value in sets.items()})


@pytest.fixture
def session() -> Session:
    session = Session()
    assert session.line(graph()).startswith("4 of 4 nodes ran in ")
    return session


class TestLine:
    def test_first(self) -> None:
        """The first run is one."""
        assert Session().line(graph()).endswith(": first run")

    def test_nothing(self, session: Session) -> None:
        """Where nothing ran, nothing had changed."""
        line = session.line(graph())
        assert line.startswith("0 of 4 nodes")
        assert "nothing that the outputs depend on has changed" in line

    def test_parameter(self, session: Session) -> None:
        """What changed is told, and not that others stand below it."""
        line = session.line(graph(c_plus=5))
        assert line.startswith("2 of 4 nodes")
        assert line.endswith(": parameter plus of c 3.0 -> 5.0")

    def test_several(self, session: Session) -> None:
        """Two changes are told, of further ones how many there are."""
        line = session.line(graph(a_plus=0, b_plus=0, c_plus=0, d_plus=0))
        assert line.endswith("parameter plus of a 1.0 -> 0.0; parameter plus of b 2.0 -> 0.0 and 2 more")

    def test_input(self, session: Session) -> None:
        """An input by its name."""
        assert session.line(graph(), x=5.0).endswith(": input x changed")

    def test_pinned(self, session: Session) -> None:
        """Pinning a node, and letting it be itself again."""
        line = session.line(graph(), pinned={"b": 9.0})
        assert line.startswith("2 of 3 nodes")
        assert line.endswith(": b is pinned")

    def test_failed(self, session: Session) -> None:
        """A failure counts, with why the node ran."""
        line = session.line(graph(), ["bad"])
        assert "1 of 5 nodes ran in" in line
        assert ", 1 failed: bad is new" in line

    def test_code(self, session: Session) -> None:
        """Changed code is told by operator, once for all nodes of it."""
        import toys

        before = toys.add.__defaults__
        toys.add.__defaults__ = (0.5,)
        try:
            assert session.line(graph()).endswith(": the code of toy.add changed")
        finally:
            toys.add.__defaults__ = before
