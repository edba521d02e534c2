"""The sheet of an ablation: whole, crop and difference, a row for each variant."""

from pathlib import Path

from PIL import Image

from graphface.ablation.running import Ablation
from graphface.ablation.sheet import WIDTH, write_sheet


def test_values_without_pictures(numbers: Ablation, tmp_path: Path) -> None:
    """Numbers have no picture; the sheet is written and says so."""
    write_sheet(numbers, tmp_path / "sheet.png")
    with Image.open(tmp_path / "sheet.png") as sheet:
        assert sheet.width >= 3 * WIDTH
        assert sheet.convert("L").getextrema()[1] > 128
