"""The page of an ablation: one file without anything beside it, opened in a browser."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from graphface import Evaluator, MemoryTier, Registry
from graphface.ablation import ablate
from graphface.ablation.page import write_page
from graphface.ablation.pictures import Pictures

GRAPH = """
graphface: 1
name: grids
inputs: {start: Grid}
nodes:
  s: {use: toy.scale, in: {grid: start}, with: {by: 2}}
  t: {use: toy.scale, in: {grid: s}}
outputs: {y: t}
"""
HOSTILE = "</script><img src=x onerror=alert(1)>"


@pytest.fixture
def written(registry: Registry, tmp_path: Path) -> Callable[..., Path]:
    def made(*swaps: str, text: str = GRAPH, cases: int = 1) -> Path:
        evaluator = Evaluator(memory=MemoryTier())
        pictures = Pictures(evaluator, "y", size=32)
        given = [{"start": np.arange(16.0).reshape(4, 4) + case} for case in range(cases)]
        done = ablate(text, swaps, given, evaluator=evaluator, loading={"registry": registry}, watcher=pictures)
        write_page(done, pictures, tmp_path / "index.html")
        return tmp_path / "index.html"

    return made


def test_nothing_is_loaded(written: Callable[..., Path]) -> None:
    """No address stands in the page."""
    text = written("s.by=1,2").read_text(encoding="utf-8")
    assert not re.findall(r"""(?:src|href)\s*=\s*["']?(?:https?:|//)""", text)


def test_hostile_words(written: Callable[..., Path]) -> None:
    """The name of a graph stays a text."""
    page = written("s.by=1,2", text=GRAPH.replace("name: grids", f"name: '{HOSTILE}'")).read_text(encoding="utf-8")
    assert HOSTILE not in page
    assert HOSTILE in json.loads(re.findall(r'id="ablated">(.*?)</script>', page)[0])["title"]


def test_table_and_pictures(written: Callable[..., Path], open_page: Any) -> None:
    """A line for each variant; the original and every variant side by side."""
    page = open_page(written("s.by=1,2,3"))
    assert [line.strip() for line in page.locator("tbody th").all_inner_texts()] == ["1 s.by=1", "2 s.by=2", "3 s.by=3"]
    titles = page.locator(".gc-title").all_inner_texts()
    assert [title.split("\n")[0].split(" ")[0] for title in titles] == ["original", "s.by=1", "s.by=2", "s.by=3"]


def test_variants_are_chosen_by_line_and_key(written: Callable[..., Path], open_page: Any) -> None:
    """Wipe, flicker and difference show the chosen one against the first, the first against the original."""
    page = open_page(written("s.by=1,2,3"))
    page.get_by_role("button", name="Difference", exact=True).click()
    page.keyboard.press("3")
    assert page.locator(".gc-title").inner_text().startswith("s.by=3 − s.by=1")
    page.locator("tbody tr").first.click()
    assert page.locator(".gc-title").inner_text().startswith("s.by=1 − original")
    page.keyboard.press("ArrowRight")
    assert page.locator("tbody tr[aria-selected=true] th").inner_text().endswith("s.by=2")


def test_nodes_in_step(written: Callable[..., Path], open_page: Any) -> None:
    """Any node that differs, of every variant; the zoom stays as it is."""
    page = open_page(written("s.by=1,2"))
    page.keyboard.press("+")
    page.locator("#place").select_option("s")
    assert page.locator(".gc-pane").count() == 3
    assert page.locator(".gc-zoom").inner_text() == "1.5 x"


def test_failed_variant(written: Callable[..., Path], open_page: Any) -> None:
    """Says why in place of its picture."""
    page = open_page(written("t=scale,write"))
    assert "read-only" in page.locator(".gc-message").inner_text()


def test_cases(written: Callable[..., Path], open_page: Any) -> None:
    """Each has its pictures."""
    page = open_page(written("s.by=1,2", cases=2))
    before = page.locator(".gc-picture").first.get_attribute("src")
    page.locator("#case").select_option("1")
    assert page.locator(".gc-pane").count() == 3
    assert before
