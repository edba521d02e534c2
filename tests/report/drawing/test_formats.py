"""Formats by name and suffix."""

from pathlib import Path

import pytest

from graphface import Graph
from graphface.errors import RefusedOutput
from graphface.report.drawing.formats import FORMATS, draw, format_of, write_drawing

BEGINS = {"svg": b"<svg", "png": b"\x89PNG", "html": b"<!DOCTYPE html>", "mermaid": b"flowchart", "dot": b"digraph"}


@pytest.mark.parametrize("form", FORMATS)
def test_draw(graph: Graph, form: str) -> None:
    """Every format can be drawn, the same each time."""
    drawn = draw(graph, form)  # type: ignore[arg-type]
    assert drawn.startswith(BEGINS[form])
    assert draw(graph, form) == drawn  # type: ignore[arg-type]


@pytest.mark.parametrize(("name", "form"), [("a.SVG", "svg"), ("a.gv", "dot"), ("a.mmd", "mermaid"), ("a.htm", "html")])
def test_suffix(name: str, form: str) -> None:
    assert format_of(Path(name)) == form


class TestWrite:
    def test_by_suffix(self, graph: Graph, tmp_path: Path) -> None:
        write_drawing(graph, tmp_path / "g.dot")
        assert (tmp_path / "g.dot").read_bytes().startswith(b"digraph")
        assert [path.name for path in tmp_path.iterdir()] == ["g.dot"]

    @pytest.mark.parametrize("name", ["g.jpg", "g", "x" * 300 + "/g.svg"])
    def test_refused(self, graph: Graph, tmp_path: Path, name: str) -> None:
        """A suffix that says nothing, or a folder that cannot be made, is refused and leaves no file."""
        with pytest.raises(RefusedOutput):
            write_drawing(graph, tmp_path / name)
        assert list(tmp_path.iterdir()) == []
