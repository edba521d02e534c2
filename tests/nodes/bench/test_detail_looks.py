"""`graphface bench details`: cases of detail transfer, and their three figures."""

from __future__ import annotations

import math

import numpy as np
import pytest

from graphface import UsageError
from graphface.nodes.bench.detail_looks import Pair, color, delivered, detail_looks, patch, read_pairs
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture

pytestmark = pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")

UNIT, MASK = 60.0, np.ones((90, 90), np.float32)
SKIN = np.full((90, 90, 3), 0.5, np.float32)


class TestFigures:
    def test_nothing(self):
        """A photo that stays has no patch, and nothing came."""
        other = SKIN * (1 + 0.2 * np.sin(np.arange(90, dtype=np.float32) / 2))[None, :, None]
        assert patch(SKIN, SKIN, MASK, UNIT) == 0
        assert color(SKIN, SKIN, MASK, UNIT) == 0
        assert delivered(SKIN, SKIN, other, MASK, UNIT) == 0
        assert delivered(SKIN, other, other, MASK, UNIT) == pytest.approx(1)

    def test_a_patch(self):
        """Darker by a tenth is a patch of ten percent without color; redder is one of color."""
        assert patch(SKIN, 0.9 * SKIN, MASK, UNIT) == pytest.approx(9.5, abs=0.5)
        assert color(SKIN, 0.9 * SKIN, MASK, UNIT) == pytest.approx(0, abs=1e-3)
        assert color(SKIN, SKIN * np.float32([1.1, 1, 1]), MASK, UNIT) > 3

    def test_no_mask(self):
        """Where nothing was to change there is no figure."""
        nothing = np.zeros_like(MASK)
        assert math.isnan(patch(SKIN, SKIN, nothing, UNIT))
        assert math.isnan(delivered(SKIN, SKIN, SKIN, nothing, UNIT))


class TestReadPairs:
    def test_lines(self, tmp_path):
        """Files count from the list's folder; regions are optional, and a comment is skipped."""
        (tmp_path / "pairs.csv").write_text("# old\na.png, b.png\nb.png, a.png, nose forehead\n")
        first, second = read_pairs(tmp_path / "pairs.csv")
        assert first == Pair(tmp_path / "a.png", tmp_path / "b.png")
        assert second.take == ("nose", "forehead")

    def test_one_file(self, tmp_path):
        """A line with a photo alone is refused."""
        (tmp_path / "pairs.csv").write_text("a.png\n")
        with pytest.raises(UsageError, match="a reference"):
            read_pairs(tmp_path / "pairs.csv")


class TestDetailLooks:
    def test_cases(self, face, tmp_path):
        """A folder for each pair that can be made, with what a scorer reads; a face onto itself has no patch."""
        write_picture(face, tmp_path / "me.png")
        (tmp_path / "none.png").write_text("no picture")
        pairs = [Pair(tmp_path / "none.png", tmp_path / "me.png"), Pair(tmp_path / "me.png", tmp_path / "me.png")]
        (found,) = detail_looks(pairs, tmp_path / "out")
        assert found.patch < 0.5
        case = tmp_path / "out" / "me_me"
        names = ("photo", "result", "warped", "known", "mask", "face", "hair", "background")
        assert {read_image(case / f"{name}.png").pixels.shape[:2] for name in names} == {face.shape[:2]}
        assert len(np.load(case / "points.npy")) == 468
