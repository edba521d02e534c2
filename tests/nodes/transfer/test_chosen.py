"""Which part of two reliefs is exchanged."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.transfer.chosen import chosen

Y, X = np.mgrid[:60, :60].astype(np.float32)
STRIPES = np.dstack([0.1 * np.sin(X)] * 3).astype(np.float32)
FLAT = np.zeros_like(STRIPES)


def dark(spread):
    """A dark place in the middle, of these standard deviations in pixels."""
    across, down = spread
    depth = np.exp(-np.square((X - 30) / across) / 2 - np.square((Y - 30) / down) / 2)
    return np.asarray(-0.3 * depth, np.float32)[..., None]


class TestChosen:
    def test_all(self):
        """Both, as they are."""
        taken, given = chosen("all", FLAT, STRIPES, 4.0)
        assert taken is FLAT
        assert given is STRIPES

    @pytest.mark.parametrize(("which", "arrives"), [("deeper", True), ("smoother", False)])
    def test_stronger(self, which, arrives):
        """A stronger reference arrives with "deeper", and stays away with "smoother"."""
        taken, given = chosen(which, FLAT, STRIPES, 4.0)
        assert np.abs(taken).max() == 0
        assert bool(np.abs(given).max() > 0.09) is arrives

    def test_weaker(self):
        """A smooth reference takes the photo's own relief off with "smoother", and not with "deeper"."""
        np.testing.assert_allclose(chosen("smoother", STRIPES, FLAT, 4.0)[0], STRIPES, atol=1e-6)
        assert np.abs(chosen("deeper", STRIPES, FLAT, 4.0)[0]).max() == 0

    def test_spots(self):
        """A dark spot comes, a line and what is bright do not, and the photo keeps its own."""
        spot, line, bright = (
            chosen("spots", STRIPES, relief, 8.0) for relief in (dark((4, 4)), dark((4, 90)), -dark((4, 4)))
        )
        assert spot[1].min() < -0.25
        assert np.abs(line[1][20:40, 25:35]).max() < 0.02
        assert np.abs(bright[1]).max() == 0
        assert np.abs(spot[0]).max() == 0
