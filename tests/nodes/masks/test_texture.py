"""The MR8 filter bank."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.masks.texture import DIRECTIONS, mr8, oriented


def stripes(angle, side=64, period=6):
    y, x = np.mgrid[:side, :side]
    wave = np.sin(2 * np.pi / period * (x * np.cos(angle) + y * np.sin(angle)))
    return (0.5 + 0.4 * wave).astype(np.float32)


class TestOriented:
    def test_36_kernels_of_mean_0(self):
        """Six edges and six bars at each scale; none sees flat color, all weigh the same."""
        edges, bars = oriented(1, 3)
        assert len(edges) == len(bars) == DIRECTIONS
        for kernel in (*edges, *bars):
            assert kernel.sum() == pytest.approx(0, abs=1e-6)
            assert np.abs(kernel).sum() == pytest.approx(1, rel=1e-5)


class TestMr8:
    @pytest.mark.parametrize("bank", ["pyramid", "full"])
    def test_shape_and_flat_color(self, bank):
        """Eight responses; flat color has none but its own lightness."""
        responses = mr8(np.full((20, 30), 0.4, np.float32), bank)
        assert responses.shape == (20, 30, 8)
        np.testing.assert_allclose(np.delete(responses, 6, axis=2), 0, atol=1e-5)
        np.testing.assert_allclose(responses[..., 6], 0.4, atol=1e-5)

    def test_direction_does_not_matter(self):
        """The maximum over directions responds alike to stripes of any of its directions."""
        middle = [mr8(stripes(k * np.pi / DIRECTIONS))[16:48, 16:48, :2].mean() for k in range(DIRECTIONS)]
        assert max(middle) < 1.15 * min(middle)

    def test_fine_stripes_answer_at_the_fine_scale(self):
        """Stripes of six pixels are seen by the finest filters, not by the coarsest."""
        middle = mr8(stripes(0.0), "full")[16:48, 16:48].mean(axis=(0, 1))
        assert middle[0] > 5 * middle[4]

    @pytest.mark.parametrize("shape", [(1, 1), (1, 9), (3, 2)])
    @pytest.mark.parametrize("bank", ["pyramid", "full"])
    def test_tiny_pictures(self, shape, bank):
        """A picture smaller than the kernels has finite responses."""
        assert np.isfinite(mr8(np.full(shape, 0.5, np.float32), bank)).all()
