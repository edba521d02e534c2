"""A graph as SVG."""

from xml.etree import ElementTree

import pytest

from graphface import Graph, load
from graphface.report.drawing.marks import Mark
from graphface.report.drawing.svg import draw_svg, escape

from .conftest import HOSTILE

SVG = "{http://www.w3.org/2000/svg}"
PIXEL = "data:image/png;base64,iVBORw0KGgo="


def elements(text: str, kind: str) -> list[ElementTree.Element]:
    return [e for e in ElementTree.fromstring(text).iter() if kind in (e.get("class") or "").split()]


class TestElements:
    def test_names(self, graph: Graph) -> None:
        """Nodes, frames and wires are found by the names in the graph."""
        drawn = draw_svg(graph)
        assert [e.get("data-node") for e in elements(drawn, "node")] == list(graph.names)
        assert [e.get("data-frame") for e in elements(drawn, "frame")] == ["f", "f/deep"]
        wires = {(e.get("data-from"), e.get("data-to")) for e in elements(drawn, "wire")}
        assert ("f/m", "f/deep/a") in wires
        assert len(elements(drawn, "wire")) == 6

    def test_marks(self, graph: Graph) -> None:
        """What is skipped is dimmed and says why; what failed has its class; heat is a bar."""
        marks = {"f/m": Mark("skipped", "nobody asked"), "g": Mark("failed", "it broke"), "p": Mark("ran", heat=0.25)}
        drawn = draw_svg(graph, marks=marks)
        by_name = {e.get("data-node"): e for e in elements(drawn, "node")}
        assert "dimmed" in by_name["f/m"].get("class", "").split()
        assert "nobody asked" in "".join(by_name["f/m"].itertext())
        assert "failed" in by_name["g"].get("class", "").split()
        assert len(elements(drawn, "heat")) == 1

    def test_thumbnails(self, graph: Graph) -> None:
        """Pictures come from data URIs alone."""
        drawn = draw_svg(graph, thumbnails={"g": PIXEL, "p": "https://example.org/x.png", "x": "javascript:alert(1)"})
        images = [e.get("href") for e in ElementTree.fromstring(drawn).iter(f"{SVG}image")]
        assert images == [PIXEL]

    def test_folded(self, graph: Graph) -> None:
        """A folded frame is one box; the nodes inside are not drawn."""
        drawn = draw_svg(graph, folded=["f"])
        (frame,) = elements(drawn, "frame")
        assert "2 boxes" in "".join(frame.itertext())
        assert "f/m" not in [e.get("data-node") for e in elements(drawn, "node")]

    def test_lazy(self, graph: Graph) -> None:
        """Wires that may be declined are told apart."""
        assert [e.get("data-to") for e in elements(draw_svg(graph), "lazy")] == ["gate"]


@pytest.mark.parametrize("name", ["relight", "makeup", "transfer", "represent", "segment"])
def test_shipped(name: str) -> None:
    """Well-formed, and the same each time."""
    graph = load(name)
    drawn = draw_svg(graph)
    assert len(elements(drawn, "node")) == len(graph.names)
    assert draw_svg(graph) == drawn


def test_hostile(hostile: Graph, hostile_marks: dict[str, Mark]) -> None:
    """Texts stay texts: no element or attribute comes out of them, and the file stays well-formed."""
    plain = draw_svg(hostile)
    drawn = draw_svg(hostile, marks=hostile_marks, thumbnails={"g": f"data:image/png,{HOSTILE}"})
    tags = {e.tag for e in ElementTree.fromstring(drawn).iter()}
    assert tags == {e.tag for e in ElementTree.fromstring(plain).iter()} | {f"{SVG}image"}
    assert "<script" not in drawn


def test_escape() -> None:
    """What no XML may hold is replaced."""
    assert escape('<a b="\'">\x00\ud800\uffff') == "&lt;a b=&quot;&#x27;&quot;&gt;\ufffd\ufffd\ufffd"
