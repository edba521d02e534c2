"""The page of a comparison, in a browser and as a text."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphface import Evaluator, MemoryTier, load
from graphface.report.difference.compare import Comparison
from graphface.report.difference.page import page_text, write_page

HOSTILE = "</script><img src=x onerror=alert(1)>"


@pytest.fixture
def written(compared: Callable[..., Comparison], tmp_path: Path) -> Callable[..., Path]:
    def made(titles: tuple[str, str] = ("one", "other"), **choices: Any) -> Path:
        comparison = compared(**choices)
        write_page(comparison, comparison.differences(), tmp_path / "diff.html", titles=titles)
        return tmp_path / "diff.html"

    return made


class TestText:
    def test_nothing_is_loaded(self, written: Callable[..., Path]) -> None:
        """No address stands in the page."""
        text = written(set={"s.by": 4}).read_text(encoding="utf-8")
        assert not re.findall(r"""(?:src|href)\s*=\s*["']?(?:https?:|//)""", text)

    def test_hostile_words(self, written: Callable[..., Path]) -> None:
        """No word of a graph or a file ends a script or begins an element."""
        text = written(titles=(HOSTILE, HOSTILE), set={"s.by": 4}).read_text(encoding="utf-8")
        assert HOSTILE not in text
        assert text.count("<script") == text.count("</script>") == 3
        (found,) = re.findall(r'id="found">(.*?)</script>', text)
        assert json.loads(found)["sides"][0]["title"] == HOSTILE

    def test_nothing_differs(self, compared: Callable[..., Comparison]) -> None:
        """The page says so."""
        comparison = compared()
        assert '"nodes":[]' in page_text(comparison, comparison.differences())


class TestBrowser:
    def test_opens_on_the_first(self, written: Callable[..., Path], open_page: Any) -> None:
        """The first node that differs is chosen, and what was changed stands above its pictures."""
        page = open_page(written(set={"s.by": 4}))
        assert page.locator("nav button[aria-current=true] .name").inner_text() == "s"
        assert "by changed from 3.0 to 4.0" in page.locator(".cause").inner_text()
        assert page.locator(".gc-pane").count() == 2

    def test_every_node_in_every_view(self, written: Callable[..., Path], open_page: Any) -> None:
        """Each can be clicked, in each view; links lead to the node above."""
        page = open_page(written(set={"s.by": 4}))
        for entry in page.locator("nav button:not(.all)").all():
            entry.click()
            for mode in ("Flicker", "Wipe", "Difference", "Side by side"):
                page.get_by_role("button", name=mode, exact=True).click()
                assert page.locator(".gc-pane").count() == (2 if mode == "Side by side" else 1)
        page.locator("nav button .name", has_text="m").click()
        page.locator(".cause a").click()
        assert page.locator("h1").inner_text() == "t (toy.scale)"
        page.keyboard.press("ArrowUp")
        assert page.locator("h1").inner_text() == "s (toy.scale)"

    def test_values_under_the_cursor(self, written: Callable[..., Path], open_page: Any) -> None:
        """Those of both sides, and their difference."""
        page = open_page(written(set={"s.by": 4}))
        port = page.locator(".gc-port").first.bounding_box()
        page.mouse.move(port["x"] + port["width"] / 2 + 2, port["y"] + port["height"] / 2 + 2)
        page.locator(".gc-position").wait_for()
        assert page.locator(".gc-readout").inner_text().split("\n") == ["x 4, y 4", "A 3", "B 4", "difference 1"]

    def test_zoom_in_step(self, written: Callable[..., Path], open_page: Any) -> None:
        """The wheel zooms both pictures about the cursor, a drag moves both, a double click shows all."""
        page = open_page(written(set={"s.by": 4}))
        first, second = (page.locator(".gc-port .gc-picture").nth(i) for i in (0, 1))
        whole = first.bounding_box()
        page.mouse.move(whole["x"] + whole["width"] / 2, whole["y"] + whole["height"] / 2)
        page.mouse.wheel(0, -240)
        page.locator(".gc-zoom", has_text="2 x").wait_for()
        page.mouse.down()
        page.mouse.move(whole["x"] + whole["width"] / 2 - 30, whole["y"] + whole["height"] / 2 - 20)
        page.mouse.up()
        ports = [page.locator(".gc-port").nth(i).bounding_box() for i in (0, 1)]
        boxes = [picture.bounding_box() for picture in (first, second)]
        assert boxes[0]["width"] == pytest.approx(2 * whole["width"], rel=0.01)
        assert boxes[0]["x"] - ports[0]["x"] == pytest.approx(boxes[1]["x"] - ports[1]["x"], abs=1)
        assert boxes[0]["y"] == pytest.approx(boxes[1]["y"], abs=1)
        page.mouse.dblclick(whole["x"] + 5, whole["y"] + 5)
        assert first.bounding_box()["width"] == pytest.approx(whole["width"], abs=1)

    def test_difference_is_signed(self, written: Callable[..., Path], open_page: Any) -> None:
        """Lighter than mid grey where B is more; the scale is said, and the gain changes it."""
        page = open_page(written(set={"s.by": 4}))
        page.get_by_role("button", name="Difference", exact=True).click()
        page.locator(".gc-scale", has_text="black").wait_for()
        assert page.locator(".gc-scale").inner_text() == "black −1, white +1"
        read = "[...document.querySelector('.gc-signed').getContext('2d').getImageData(3, 3, 1, 1).data]"
        assert page.evaluate(read) == [255, 255, 255, 255]
        page.get_by_label("gain of the difference").fill("-1")
        assert page.locator(".gc-scale").inner_text() == "black −2, white +2"
        assert page.evaluate(read)[0] == pytest.approx(191, abs=1)

    def test_flicker_and_wipe(self, written: Callable[..., Path], open_page: Any) -> None:
        """Space shows the other; the wipe follows the drag of its handle."""
        page = open_page(written(set={"s.by": 4}))
        page.locator(".gc-stage").focus()
        page.keyboard.press("f")
        title = page.locator(".gc-title")
        page.keyboard.press(" ")
        shown = title.inner_text()[:1]
        page.keyboard.press(" ")
        assert {shown, title.inner_text()[:1]} == {"A", "B"}
        page.keyboard.press("w")
        handle = page.locator(".gc-handle")
        box = handle.bounding_box()
        page.mouse.move(box["x"] + 8, box["y"] + 50)
        page.mouse.down()
        page.mouse.move(box["x"] - 92, box["y"] + 50)
        page.mouse.up()
        assert int(handle.get_attribute("aria-valuenow")) < 45

    def test_failures_and_absences(self, compared: Callable[..., Comparison], open_page: Any, tmp_path: Path) -> None:
        """A node without a value says why in place of its picture."""
        head = "graphface: 1\nnodes:\n  a: {use: toy.number}\n"
        one = head + "  f: {use: toy.add, in: {a: a}}\noutputs: {y: f}\n"
        other = head + "  f: {use: toy.fail, in: {a: a}, with: {message: '<b>bold</b>'}}\noutputs: {y: f}\n"
        comparison = compared(other, one)
        write_page(comparison, comparison.differences(), tmp_path / "d.html")
        page = open_page(tmp_path / "d.html")
        assert "<b>bold</b>" in page.locator(".gc-message").inner_text()
        assert page.locator(".gc-message b").count() == 0
        page.get_by_role("button", name="Difference", exact=True).click()
        page.locator(".gc-title", has_text="no picture").wait_for()

    def test_all_in_one_column(self, written: Callable[..., Path], open_page: Any) -> None:
        """Both pictures and the difference of every node, in order."""
        page = open_page(written(set={"s.by": 4}))
        page.locator(".all").click()
        assert [h.split(" ")[0] for h in page.locator(".column h2").all_inner_texts()] == ["s", "t", "m", "n"]
        page.locator(".column h2 a").nth(1).click()
        assert page.locator("h1").inner_text() == "t (toy.scale)"

    def test_one_pixel_is_not_lost(self, open_page: Any, tmp_path: Path) -> None:
        """The mask of a large picture shows the one pixel that differs, the ring stands around it."""
        encode = "{use: image.encode, in: {photo: photo}, with: {encoding: srgb}}"
        text = f"graphface: 1\ninputs: {{photo: Image}}\nnodes: {{e: {encode}}}\noutputs: {{image: e}}\n"
        graph = load(text)
        black = np.zeros((300, 200, 3), np.float32)
        spot = black.copy()
        spot[151, 33] = 1
        comparison = Comparison(
            graph.request({"photo": black}), graph.request({"photo": spot}), Evaluator(memory=MemoryTier())
        )
        write_page(comparison, comparison.differences(), tmp_path / "d.html", size=64)
        page = open_page(tmp_path / "d.html")
        page.keyboard.press("m")
        port, ring = (
            page.locator(f".gc-pane:first-child {what}").bounding_box() for what in (".gc-picture", ".gc-ring")
        )
        assert ring["x"] + ring["width"] / 2 == pytest.approx(port["x"] + port["width"] * 33.5 / 200, abs=2)
        red = """() => {
            const image = document.querySelector(".gc-mask"), canvas = document.createElement("canvas");
            [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
            const pen = canvas.getContext("2d");
            pen.drawImage(image, 0, 0);
            const {data} = pen.getImageData(0, 0, canvas.width, canvas.height);
            return data.filter((value, i) => i % 4 === 3 && value).length;
        }"""
        assert page.evaluate(red) == 1
