"""Segmentation against heads whose labels are known: a quality gate, where the data and the networks are at hand."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.bench.heads import LABELS
from graphface.nodes.bench.segmentation_truth import boundary_error, overlaps, segment_truth


@pytest.fixture(scope="module")
def rows(networks, shared):
    return list(segment_truth(shared, ("none", "guided")))


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

    def test_labels_cost_the_same_whatever_the_matting(self, rows):
        """They are shared, and charged to each."""
        for head in {row.head for row in rows}:
            assert len({row.labels_ms for row in rows if row.head == head}) == 1

    def test_no_heads_is_an_error(self, tmp_path):
        """A folder without truth is named."""
        with pytest.raises(UnreadableFile, match="no heads"):
            next(segment_truth(tmp_path))


class TestOverlaps:
    def test_of_each_label(self):
        """Shared pixels over all pixels; a label that neither map has agrees."""
        found, truth = np.zeros((2, 10), np.intp), np.zeros((2, 10), np.intp)
        found[0, :6] = truth[0, 3:] = 1
        assert overlaps(found, truth) == pytest.approx((10 / 17, 0.3, 1))


class TestBoundaryError:
    def test_of_a_shift(self):
        """A disc moved by three pixels has its outline about two pixels off on average, and none of its own."""
        y, x = np.mgrid[:80, :80]
        disc = (x - 40) ** 2 + (y - 40) ** 2 < 400
        assert boundary_error(disc, disc) == 0
        assert boundary_error(disc, np.roll(disc, 3, axis=1)) == pytest.approx(3 * 2 / np.pi, abs=0.3)

    def test_missing(self):
        """Where only one has an outline, the error is the picture's size."""
        disc = np.zeros((20, 30), bool)
        other = disc.copy()
        other[5:9, 5:9] = True
        assert boundary_error(disc, other) == 30
