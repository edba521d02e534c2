"""A plan as marks."""

from graphface import Evaluator, Graph
from graphface.evaluate.plan import plan
from graphface.report.drawing.planned import marks_of


def test_marks(graph: Graph) -> None:
    """What would run, and what is skipped with the reason."""
    asked = graph.request({"x": 1.0}, ["pair"])
    marks = marks_of(plan(asked, Evaluator()))
    assert marks["g"].words == "would run"
    assert marks["gate"].state == "skipped"
    assert marks["gate"].reason == "not needed for pair"
