"""The page of an ablation: one file, without anything beside it."""

from pathlib import Path

from graphface.ablation.page import write_page
from graphface.ablation.running import Ablation


def test_values_without_pictures(numbers: Ablation, tmp_path: Path) -> None:
    """Numbers have no picture; the page is written with its table, a line for each variant."""
    write_page(numbers, tmp_path / "index.html")
    text = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert text.count("<tr data-v=") == 2
    assert "src=" not in text.replace('src="data:', "")
