"""Relief of skin in three bands."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.face_scale import FaceScale
from graphface.nodes.relief import filled, logarithm, relief

SIDE, UNIT = 160, 100.0
COPY = FaceScale((SIDE, SIDE), (SIDE, SIDE), 1.0, UNIT)
EVERYWHERE = np.ones((SIDE, SIDE), np.float32)
X = np.broadcast_to(np.arange(SIDE, dtype=np.float32), (SIDE, SIDE))
MIDDLE = SIDE // 2


def line(width):
    """A dark vertical line of a standard deviation in inter-ocular distances, 0.2 deep, H x W x 1."""
    depth = 0.2 * np.exp(-np.square((X - MIDDLE) / (width * UNIT)) / 2)
    return np.asarray(-depth - 0.7, np.float32)[..., None]


class TestRelief:
    @pytest.mark.parametrize(("width", "band"), [(0.004, "pores"), (0.012, "lines"), (0.02, "folds")])
    def test_bands(self, width, band):
        """A line is in the band of its width more than in the others, and dark."""
        found = relief(line(width), EVERYWHERE, COPY)
        depths = {name: -float(getattr(found, name)[MIDDLE, MIDDLE, 0]) for name in ("pores", "lines", "folds")}
        assert max(depths, key=lambda name: depths[name]) == band
        assert sum(depths.values()) == pytest.approx(0.2, abs=0.06)

    def test_the_same_on_dark_skin(self):
        """A tenth of the light gives the same relief, up to the floor."""
        pale = np.exp(line(0.012))
        bright, dark = (relief(logarithm(pale * k), EVERYWHERE, COPY) for k in (1.0, 0.5))
        assert dark.lines.min() == pytest.approx(bright.lines.min(), rel=0.15)

    def test_the_edge_of_a_shadow_is_no_relief(self):
        """Light on one side and shadow on the other leave next to nothing; a Gaussian would leave lines."""
        step = np.asarray(0.5 / (1 + np.exp(-(X - MIDDLE) / 3)) - 1, np.float32)[..., None]
        found = relief(step, EVERYWHERE, COPY)
        assert max(np.abs(band).max() for band in (found.pores, found.lines, found.folds)) < 0.05

    def test_hair_beside_skin(self):
        """What is not skin has no relief, and leaves none in the skin beside it."""
        skin = np.asarray(X < MIDDLE, np.float32)
        values = np.where(skin > 0, -0.5, -2.5).astype(np.float32)[..., None]
        found = relief(values, skin, COPY)
        for band in (found.pores, found.lines, found.folds):
            assert np.abs(band).max() < 0.02
            assert np.abs(band[skin == 0]).max() == 0

    def test_no_skin(self):
        """Nothing, and everything finite."""
        found = relief(line(0.01), np.zeros_like(EVERYWHERE), COPY)
        assert all(np.abs(band).max() == 0 for band in (found.pores, found.lines, found.folds))


class TestFilled:
    def test_near_values(self):
        """A hole gets what is around it, and what is known stays."""
        values = np.asarray(X, np.float32)[..., None]
        weight = EVERYWHERE.copy()
        weight[60:100, 60:100] = 0
        got = filled(values, weight, UNIT)
        np.testing.assert_allclose(got[weight > 0], values[weight > 0], atol=1e-4)
        assert got[80, 80, 0] == pytest.approx(80, abs=12)


class TestLogarithm:
    def test_negative_is_black(self):
        """No value is undefined."""
        np.testing.assert_array_equal(logarithm(np.float32([-1, 0])), logarithm(np.float32([0, 0])))
