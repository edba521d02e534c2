"""The page in a browser, from file://: every node opens, values are read where they are, texts stay texts."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import Open
from numpy.typing import NDArray
from toys import Grid, toy_registry

from graphface import Evaluator, Registry, RunFailed, load, node
from graphface.report.page.html import write_report
from graphface.report.recorder import Recorder

HOSTILE = "</script><img src=x onerror=window.hostile=1><!-- \u2028 \"'&amp;"
SIZE = 64


@node("hostile.texts")
def texts(grid: Grid, *, text: str = "") -> Grid:
    """<img src=x onerror=window.hostile=1>"""
    from graphface import warn

    warn(f"{HOSTILE} {text}")
    return grid


@node("hostile.ramp")
def ramp(*, height: int = 150, width: int = 200) -> Grid:
    """A ramp with a hole: NaN and both infinities in its corner."""
    made = np.arange(height * width, dtype=np.float64).reshape(height, width) / 7
    made[:30, :30], made[:30, 30:60], made[30:60, :30] = np.nan, np.inf, -np.inf
    return made


@node("hostile.top")
def top(grid: Grid) -> float:
    return float(np.nanmax(grid))


GRAPH: dict[str, Any] = {
    "graphface": 1,
    "name": HOSTILE,
    "doc": HOSTILE,
    "inputs": {"x": {"type": "float", "default": 2, "doc": HOSTILE}},
    "nodes": {
        "ramp": {"use": "hostile.ramp"},
        "texts": {"use": "hostile.texts", "in": {"grid": "ramp"}, "with": {"text": HOSTILE}},
        "scaled": {"use": "toy.scale", "in": {"grid": "texts"}},
        "pair": {"use": "toy.pair", "in": {"grid": "scaled"}},
        "low": {"use": "toy.scale", "in": {"grid": "pair.low"}},
        "top": {"use": "hostile.top", "in": {"grid": "low"}},
        "unasked": {"use": "toy.add", "in": {"a": "top"}},
        "bad": {"use": "toy.fail", "in": {"a": "top"}, "with": {"message": HOSTILE}},
    },
}


def _registry() -> Registry:
    registry = toy_registry().extended()
    for function in (texts, ramp, top):
        registry.add(function)
    return registry


def _report(path: Path, output: str) -> Path:
    evaluator = Evaluator(guard="off")
    recorder = Recorder(evaluator.find, SIZE)
    try:
        evaluator.run(load(GRAPH, registry=_registry()).request({}, [output]), [recorder])
    except RunFailed as error:
        recorder.stopped(error)
    write_report(recorder, path)
    return path


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return _report(tmp_path_factory.mktemp("report") / "a <b> & #1.html", "top")


@pytest.fixture(scope="module")
def failed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return _report(tmp_path_factory.mktemp("report") / "failed.html", "bad")


@pytest.fixture
def open_page(open_page: Open) -> Iterator[Open]:
    """Opens a report; afterwards nothing hostile ran."""
    pages = []

    def opened(path: Path, place: str = "") -> Any:
        page = open_page(path, place=place)
        page.wait_for_selector("#panel h2")
        pages.append(page)
        return page

    yield opened
    assert [page.evaluate("window.hostile") for page in pages] == [None] * len(pages)


def _chosen(page: Any) -> str:
    return str(page.text_content("#panel h2"))


def _click(page: Any, name: str) -> None:
    page.dispatch_event(f'#drawing [data-node="{name}"] .box', "click")


def _place(page: Any, column: int, row: int) -> tuple[float, float]:
    """Where on the screen a pixel of the report's picture is, 64 x 48 of them, fitted into the canvas."""
    box = page.locator(".viewer canvas").bounding_box()
    scale = min(box["width"] / 64, box["height"] / 48)
    x = box["x"] + (box["width"] - 64 * scale) / 2 + (column + 0.5) * scale
    y = box["y"] + (box["height"] - 48 * scale) / 2 + (row + 0.5) * scale
    return x, y


def _read(page: Any, column: int, row: int) -> str:
    """What the page says of a pixel of the report's picture."""
    for _ in range(100):  # until the values are unpacked
        page.mouse.move(*_place(page, column, row))
        said = _readout(page)
        if said.startswith("at "):
            return said
        page.mouse.move(0, 0)
        page.wait_for_timeout(20)
    raise AssertionError(f"no value was read: {said}")


def _readout(page: Any) -> str:
    return " ".join(page.locator(".readout span").all_text_contents())


def _sampled(array: NDArray[np.float64], column: int, row: int) -> tuple[int, int, float]:
    """The place in the whole array that a pixel of the report stands for, and its value."""
    x, y = int((column + 0.5) * array.shape[1] / 64), int((row + 0.5) * array.shape[0] / 48)
    return x, y, float(array[y, x])


def test_every_node(open_page: Any, finished: Path) -> None:
    """A click on any node shows it: its name, its state, a picture or the reason why there is none."""
    page = open_page(finished)
    for name in ("x", *GRAPH["nodes"]):
        _click(page, name)
        assert _chosen(page) == name
        assert page.locator("#panel .state").count() >= 1
        assert page.locator("#panel canvas, #panel .none.large").count() == 1
        assert page.locator(f'#drawing .chosen[data-node="{name}"]').count() == 1
    assert page.locator("#drawing .node image").count() == 7


@pytest.mark.parametrize(("column", "row"), [(40, 10), (63, 47), (20, 40)])
def test_value(open_page: Any, finished: Path, column: int, row: int) -> None:
    """The value under the cursor is the array's, within one step of the packing, at its place in the array."""
    page = open_page(finished, "#ramp")
    x, y, value = _sampled(ramp(), column, row)
    said = _read(page, column, row)
    assert said.startswith(f"at {x}, {y} ")
    step = np.nanmax(ramp()[np.isfinite(ramp())]) / 65532
    assert float(said.rsplit(" ", 1)[1]) == pytest.approx(value, abs=step, rel=1e-4)


@pytest.mark.parametrize(("column", "row", "text"), [(2, 2, "NaN"), (12, 2, "+inf"), (2, 12, "−inf")])
def test_no_number(open_page: Any, finished: Path, column: int, row: int, text: str) -> None:
    """NaN and infinities are read as such."""
    assert _read(open_page(finished, "#ramp"), column, row).endswith(f" {text}")


def test_zoom(open_page: Any, finished: Path) -> None:
    """The wheel and a double click zoom around the cursor; buttons and keys zoom and fit."""
    page = open_page(finished, "#ramp")
    before = _read(page, 40, 20)
    zooms = []
    for act in (
        lambda: page.mouse.wheel(0, -400),
        lambda: page.mouse.dblclick(*_place(page, 40, 20)),
        lambda: page.click(".viewer [aria-label=Larger]"),
        lambda: page.click(".viewer >> text=1:1"),
        lambda: page.click(".viewer >> text=Fit"),
    ):
        act()
        page.wait_for_timeout(50)
        if len(zooms) < 2:
            assert _readout(page) == before
        page.mouse.move(5, 5)
        zooms.append(int(_readout(page).split(" %")[0].rsplit(" ", 1)[1]))
        page.mouse.move(*_place(page, 40, 20))
    fitted = zooms[-1]
    assert fitted < zooms[0] < zooms[1] < zooms[2]
    assert zooms[3] == 100


def test_wide_and_narrow(open_page: Any, finished: Path) -> None:
    """At no width does the page run out of the window sideways."""
    page = open_page(finished, "#texts")
    for width in (800, 1280, 1920):
        page.set_viewport_size({"width": width, "height": 900})
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        assert page.evaluate(
            "document.querySelector('#panel').scrollWidth <= document.querySelector('#panel').clientWidth"
        )


def test_search(open_page: Any, finished: Path) -> None:
    """ "/" searches by name, operator and warning; Enter goes to what was found."""
    page = open_page(finished)
    for words, found in (("low", "low"), ("hostile.top", "top"), ("onerror", "texts")):
        page.keyboard.press("/")
        page.keyboard.type(words)
        assert page.locator("#found [role=option]").count() == 1
        page.keyboard.press("Enter")
        assert _chosen(page) == found
    page.keyboard.press("/")
    page.keyboard.type("no such thing")
    assert "nothing of that name" in page.text_content("#found")
    page.keyboard.press("Escape")
    assert page.locator("#drawing .faint").count() == 0


def test_keyboard(open_page: Any, finished: Path) -> None:
    """Arrows walk along the wires."""
    page = open_page(finished, "#scaled")
    page.keyboard.press("ArrowLeft")
    assert _chosen(page) == "texts"
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    assert _chosen(page) == "pair"


def test_links(open_page: Any, finished: Path) -> None:
    """Inputs and readers are links, the address follows, and an address opens its node."""
    page = open_page(finished, "#low")
    assert _chosen(page) == "low"
    page.click("#panel .source >> text=pair.low")
    assert _chosen(page) == "pair"
    assert page.url.endswith("#pair")
    page.click('#panel [data-to="low"]')
    assert _chosen(page) == "low"


def test_views(open_page: Any, finished: Path) -> None:
    """Table, timeline, YAML and inputs have what was run."""
    page = open_page(finished)
    page.click("#tab-nodes")
    assert page.locator("#view-nodes tbody tr").count() == 1 + len(GRAPH["nodes"])
    page.click("#view-nodes thead >> text=time")
    page.click("#tab-timeline")
    assert page.locator("#view-timeline .bar").count() == 6
    page.click("#view-timeline [data-to=top]", force=True)
    assert _chosen(page) == "top"
    page.click("#tab-yaml")
    assert "toy.scale" in page.text_content("#view-yaml")
    page.click("#tab-run")
    assert "numpy" in page.text_content("#view-run")


def test_failed(open_page: Any, failed: Path) -> None:
    """The report of a failed run opens on the node that failed, with what it was given; a click goes there."""
    page = open_page(failed)
    assert _chosen(page) == "bad"
    assert HOSTILE.replace("\u2028", "") in page.text_content("#panel .error").replace("\u2028", "")
    assert page.locator("#panel .port.big img").count() == 1
    page.click("#panel .port.big a")
    assert _chosen(page) == "top"


def test_hostile_texts(open_page: Any, finished: Path) -> None:
    """Names, parameters, warnings and documentation are shown as they are written."""
    page = open_page(finished, "#texts")
    assert page.text_content("#graph") == HOSTILE
    assert HOSTILE in page.text_content("#panel .warnings")
    assert "<img src=x onerror=window.hostile=1>" in page.text_content("#panel .doc")
    assert page.locator("img[src=x]").count() == 0
