"""A graph as a page, also in a browser where there is one."""

import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
from browser import Open

from graphface import Graph, load
from graphface.report.drawing.html import draw_html
from graphface.report.drawing.marks import Mark


class Tags(HTMLParser):
    """Collects start tags, and attributes that run something."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[str] = []
        self.active: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append(tag)
        self.active += [f"{name}={value}" for name, value in attrs if name.startswith("on") or name == "src"]


def test_complete(graph: Graph) -> None:
    """One file: nothing is fetched from elsewhere."""
    page = draw_html(graph)
    addresses = set(re.findall(r"https?://[^\s\"'<]+", page))
    assert addresses == {"http://www.w3.org/2000/svg"}
    assert len(json.loads(page.partition('id="states">')[2].partition("</script>")[0])) == 3


def test_hostile(hostile: Graph, graph: Graph, hostile_marks: dict[str, Mark]) -> None:
    """Texts stay texts: the same tags as of a harmless graph."""
    harmless = {name: Mark(mark.state, "a b c " * 30, mark.heat, "") for name, mark in hostile_marks.items()}
    tags = Tags(draw_html(hostile, marks=hostile_marks))
    assert tags.found.count("script") == 2
    assert set(tags.found) == set(Tags(draw_html(graph, marks=harmless)).found)
    assert tags.active == []


@pytest.fixture
def page(open_page: Open, tmp_path: Path) -> Any:
    """Relight in a browser."""
    path = tmp_path / "relight.html"
    path.write_text(draw_html(load("relight")), encoding="utf-8")
    return open_page(path)


class TestBrowser:
    def test_folds(self, page: Any) -> None:
        """A click opens and folds a frame, the buttons all of them."""
        mesh = page.locator('[data-node="face/mesh"]')
        assert not mesh.is_visible()
        page.locator('[data-frame="face"] > rect').click()
        assert mesh.is_visible()
        page.click("#fold")
        assert not mesh.is_visible()
        page.click("#open")
        assert page.locator(".node:visible").count() == page.locator(".node").count() > 50

    def test_search(self, page: Any) -> None:
        """Enter goes to what is found, also inside a folded frame."""
        page.fill("#search", "geometry.morph")
        assert page.locator("#found").text_content() == "1 found"
        page.press("#search", "Enter")
        assert page.locator('[data-node="face/mesh"]').is_visible()

    def test_hover(self, page: Any) -> None:
        """What feeds a node and what it feeds stays, the rest fades."""
        page.click("#open")
        page.locator('[data-node="face/intrinsic"]').hover()
        related = {e.get_attribute("data-node") for e in page.locator(".node.related").all()}
        assert {"photo", "face/unclipped", "face/albedo", "image"} <= related
        assert "panorama" not in related

    def test_text_stays_in_its_box(self, page: Any) -> None:
        """In the browser's own font no text is wider than its box."""
        page.click("#open")
        assert (
            page.evaluate(
                """() => [...document.querySelectorAll(".node text")].filter((text) => {
                const box = text.parentNode.querySelector(".box").getBBox(), own = text.getBBox();
                return own.x < box.x - 0.5 || own.x + own.width > box.x + box.width + 0.5 ||
                    own.y + own.height > box.y + box.height + 1;
            }).map((text) => text.textContent)"""
            )
            == []
        )
