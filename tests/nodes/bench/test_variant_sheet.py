"""Results of variants side by side with the truth."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.bench.variant_sheet import variant_sheets
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture


def paint(path, value):
    path.parent.mkdir(parents=True, exist_ok=True)
    write_picture(np.full((20, 20, 3), value, np.uint8), path)


class TestVariantSheets:
    def test_a_sheet_for_each_subject_a_row_for_each_light(self, tmp_path):
        """First the truth, then the variants in the order asked for."""
        paint(tmp_path / "data/truth/gt01/top.png", 250)
        paint(tmp_path / "out/plain/gt01/top.png", 150)
        paint(tmp_path / "out/other/gt01/top.png", 100)
        (written,) = variant_sheets(tmp_path / "out", ["plain", "other"], tmp_path / "data", "heads", width=40)
        assert written.name == "sheet-gt01.png"
        row = np.rint(read_image(written).pixels[50, :, 0] * 255)
        assert [row[20], row[64], row[108]] == [250, 150, 100]

    def test_a_missing_result_is_named(self, tmp_path):
        """A variant that did not write a picture is no empty cell."""
        paint(tmp_path / "data/yaleb/yaleB01/yaleB01_P00A+000E+45.png", 250)
        paint(tmp_path / "out/plain/yaleB01/A+000E+45.png", 150)
        with pytest.raises(UnreadableFile, match="other"):
            variant_sheets(tmp_path / "out", ["plain", "other"], tmp_path / "data", "yale")
