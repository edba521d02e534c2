"""Clusters of color, and intensities that make shading continuous."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.intrinsic.reflectances import Palette, clusters, with_continuous_shading


class TestClusters:
    def test_finds_separate_colors(self):
        """Pixels of one color have one label, those of another another."""
        hue = np.zeros((4, 6, 3), np.float32)
        hue[:, :3], hue[:, 3:] = (0.6, 0.2, 0.2), (0.2, 0.2, 0.6)
        palette = clusters(np.zeros((4, 6), np.float32), hue, 2)
        assert len(np.unique(palette.label[:, :3])) == len(np.unique(palette.label[:, 3:])) == 1
        assert palette.label[0, 0] != palette.label[0, 5]
        np.testing.assert_allclose(palette.hues[palette.label], hue, atol=1e-5)

    def test_no_more_clusters_than_pixels(self):
        """One pixel has one reflectance."""
        assert len(clusters(np.zeros((1, 1), np.float32), np.zeros((1, 1, 3), np.float32), 20).intensities) == 1


class TestWithContinuousShading:
    def test_the_step_becomes_reflectance(self):
        """Two labels under even light get intensities that differ by the step between them."""
        intensity = np.zeros((4, 6), np.float32)
        intensity[:, 3:] = -1
        label = (np.arange(6) >= 3).astype(np.intp) * np.ones((4, 1), np.intp)
        start = Palette(label, np.zeros(2, np.float32), np.zeros((2, 3), np.float32))
        found = with_continuous_shading(start, label, intensity)
        assert found.intensities[0] - found.intensities[1] == pytest.approx(1, abs=0.01)

    def test_one_label_stays(self):
        """Without a border there is nothing to adjust."""
        start = Palette(np.zeros((3, 3), np.intp), np.float32([0.5]), np.zeros((1, 3), np.float32))
        found = with_continuous_shading(start, start.label, np.zeros((3, 3), np.float32))
        np.testing.assert_array_equal(found.intensities, start.intensities)
