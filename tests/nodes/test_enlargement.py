"""Maps of a small picture at the size of a large one."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from graphface.nodes.enlargement import Enlarged, linear_masks
from graphface.nodes.face_scale import FaceScale


class TestEnlarged:
    @pytest.mark.parametrize("shape", [(7, 9), (1, 9), (7, 1), (1, 1), (20, 30)])
    def test_is_opencvs_bilinear_enlargement(self, shape, rng):
        """In any rows, whatever the ratio."""
        maps = [rng.random(shape, np.float32) for _ in range(2)]
        rows = [Enlarged(maps, (20, 30)).rows(rows) for rows in (slice(0, 6), slice(6, 7), slice(7, 20))]
        expected = [cv2.resize(map_, (30, 20), interpolation=cv2.INTER_LINEAR) for map_ in maps]
        np.testing.assert_allclose(np.concatenate(rows, axis=1), np.stack(expected), atol=1e-6)

    def test_the_same_size_is_not_touched(self, rng):
        """Values to the last bit."""
        map_ = rng.random((5, 4), np.float32)
        np.testing.assert_array_equal(Enlarged([map_], (5, 4)).rows(slice(1, 3))[0], map_[1:3])


class TestLinearMasks:
    def test_is_the_mask_on_the_small_picture(self, rng):
        """The function of color is exact there."""
        small, mask = rng.random((16, 16, 3), np.float32), rng.random((16, 16), np.float32)
        copy = FaceScale((16, 16), (8, 8), 0.5, 20.0)
        *slopes, rest = linear_masks({"one": mask}, small, copy, radius=0.1, ridge=1e-3)["one"]
        value = sum(slope * small[..., channel] for channel, slope in enumerate(slopes)) + rest
        np.testing.assert_allclose(value, mask, atol=1e-5)
