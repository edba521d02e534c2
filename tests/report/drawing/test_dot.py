"""A graph in DOT."""

import re

from graphface import Graph
from graphface.report.drawing.dot import draw_dot, quoted
from graphface.report.drawing.marks import Mark

STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')


def skeleton(text: str) -> list[str]:
    """The text without what stands in quotes."""
    return STRING.sub('""', text).splitlines()


def test_nested(graph: Graph) -> None:
    """Frames are clusters; wires join the fields of records."""
    drawn = draw_dot(graph)
    assert drawn.count("subgraph cluster_") == 2
    assert drawn.count("{") == drawn.count("}")
    assert "n3:o0 -> n4:i0;" in drawn
    assert "[style=dashed]" in drawn


def test_dimmed(graph: Graph) -> None:
    drawn = draw_dot(graph, marks={"g": Mark("skipped", "not needed")})
    assert 'style="filled,dashed"' in drawn


def test_hostile(hostile: Graph, graph: Graph, hostile_marks: dict[str, Mark]) -> None:
    """Texts stay inside their quotes: what is left without them is the same as of a harmless graph."""
    harmless = {name: Mark(mark.state, "reason", mark.heat, "label") for name, mark in hostile_marks.items()}
    assert skeleton(draw_dot(hostile, marks=hostile_marks)) == skeleton(draw_dot(graph, marks=harmless))
    assert "\x00" not in draw_dot(hostile, marks=hostile_marks)


def test_quoted() -> None:
    assert quoted('a "b"\n\\') == '"a \\"b\\" \\\\"'
