"""A graph as Mermaid text."""

import re

from graphface import Graph
from graphface.report.drawing.marks import Mark
from graphface.report.drawing.mermaid import draw_mermaid, quoted

LINE = re.compile(
    r"""\s*(end|flowchart\ LR|subgraph\ f\d+\["[^"<>`]*"\]|n\d+(\(\[|\[)"([^"<>`]|<br/>)*"(\]\)|\])
    |n\d+\ (-->|-\.->)\ n\d+|classDef\ \w+\ [\w#:,. -]+|class\ [n\d,]+\ \w+)""",
    re.VERBOSE,
)


def test_nested(graph: Graph) -> None:
    """Frames are subgraphs that open and close; lazy wires are dashed."""
    lines = draw_mermaid(graph).splitlines()
    assert lines[0] == "flowchart LR"
    assert sum("subgraph" in line for line in lines) == 2
    assert sum(line.strip() == "end" for line in lines) == 2
    assert sum("-.->" in line for line in lines) == 1
    assert all(LINE.fullmatch(line) for line in lines)


def test_dimmed(graph: Graph) -> None:
    drawn = draw_mermaid(graph, marks={"g": Mark("skipped", "not needed")})
    assert "skipped:" in drawn.replace("#58;", ":")
    assert "class n3 dimmed" in drawn


def test_hostile(hostile: Graph, hostile_marks: dict[str, Mark]) -> None:
    """Texts stay inside their quotes, as character codes; every line is one of the language's few."""
    drawn = draw_mermaid(hostile, marks=hostile_marks)
    assert all(LINE.fullmatch(line) for line in drawn.splitlines())


def test_quoted() -> None:
    assert quoted('a "b"\n<c>') == '"a #34;b#34; #60;c#62;"'
