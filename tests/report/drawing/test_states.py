"""The layouts that a page switches between."""

from graphface import Graph
from graphface.report.drawing.figure import figure
from graphface.report.drawing.states import as_json, foldings, states


class TestFoldings:
    def test_every_way(self) -> None:
        """Every combination that can be seen: inside a folded frame nothing is."""
        ways = foldings(["f", "f/g", "h"], 48)
        assert set(ways) == {frozenset(w) for w in ((), ("f",), ("f/g",), ("h",), ("f", "h"), ("f/g", "h"))}
        assert ways[0] == frozenset()

    def test_too_many(self) -> None:
        """Where they are too many: all open, each alone, all folded."""
        frames = [f"f{i}" for i in range(20)]
        ways = foldings(frames, 10)
        assert len(ways) == 10
        assert ways[0] == frozenset()
        assert ways[-1] == frozenset(frames)

    def test_deep(self) -> None:
        """A thousand frames in each other are no deeper than the stack."""
        assert len(foldings(["/".join("f" * depth) for depth in range(1, 1000)], 48)) <= 48


def test_json(graph: Graph) -> None:
    """Places in the order of the drawing's elements; None for what a folded frame hides."""
    drawn = figure(graph)
    known = [as_json(drawn, placed, ["f", "f/deep"]) for placed in states(drawn)]
    assert [state["folded"] for state in known] == [[], ["f/deep"], ["f"]]
    assert all(corner is not None for corner in known[0]["nodes"])
    hidden = [name for name, corner in zip(graph.names, known[2]["nodes"], strict=True) if corner is None]
    assert sorted(hidden) == ["f/deep/a", "f/m"]
    assert known[2]["frames"][1] is None
    assert known[2]["wires"].count("") == 1
