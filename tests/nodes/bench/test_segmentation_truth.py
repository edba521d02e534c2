"""Segmentation against heads whose labels are known: a quality gate, where the data and the networks are at hand."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.assets.asset import AssetUnavailable
from graphface.nodes.bench.segmentation_truth import LABELS, MATTINGS, boundary_error, iou, segment_truth


@pytest.fixture(scope="module")
def rows(shared):
    try:
        return list(segment_truth(shared, {name: MATTINGS[name] for name in ("none", "guided")}))
    except AssetUnavailable as error:
        pytest.skip(str(error))


class TestSegmentTruth:
    @pytest.mark.parametrize(("matting", "least"), [("none", (0.955, 0.90, 0.965)), ("guided", (0.965, 0.945, 0.975))])
    def test_keeps_its_quality(self, rows, matting, least):
        """Mean overlap of face, hair and background stays near what was reached (guided: 0.977, 0.960, 0.986)."""
        found = np.mean([row.iou for row in rows if row.matting == matting], axis=0)
        assert (found > least).all(), dict(zip(LABELS, found, strict=True))

    def test_matting_sharpens(self, rows):
        """The guided filter brings hair's outline nearer to the truth than the classifiers alone."""
        edge = {m: np.mean([row.boundary[1] for row in rows if row.matting == m]) for m in ("none", "guided")}
        assert edge["guided"] < 0.7 * edge["none"]

    def test_no_heads_is_an_error(self, tmp_path):
        """A folder without truth is named."""
        with pytest.raises(UnreadableFile, match="no heads"):
            next(segment_truth(tmp_path))


class TestFigures:
    def test_iou(self):
        """Shared pixels over all pixels; two empty masks agree."""
        a, b = np.arange(10) < 6, np.arange(10) >= 3
        assert iou(a, b) == pytest.approx(0.3)
        assert iou(a & ~a, a & ~a) == 1

    def test_boundary_error_of_a_shift(self):
        """A disc moved by three pixels has its outline about two pixels off on average, and none of its own."""
        y, x = np.mgrid[:80, :80]
        disc = (x - 40) ** 2 + (y - 40) ** 2 < 400
        assert boundary_error(disc, disc) == 0
        assert boundary_error(disc, np.roll(disc, 3, axis=1)) == pytest.approx(3 * 2 / np.pi, abs=0.3)

    def test_boundary_missing(self):
        """Where only one has an outline, the error is the picture's size."""
        disc = np.zeros((20, 30), bool)
        other = disc.copy()
        other[5:9, 5:9] = True
        assert boundary_error(disc, other) == 30
