"""Values as pictures."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types.pictures import (
    as_bytes,
    picture_albedo,
    picture_depth,
    picture_gain,
    picture_normals,
    picture_signed,
)


class TestAsBytes:
    def test_clips_and_rounds(self):
        """0..1 to 0..255; one channel becomes three."""
        np.testing.assert_array_equal(as_bytes(np.float32([[-1, 0.5, 2]]))[0, :, 0], [0, 128, 255])
        assert as_bytes(np.zeros((2, 2), np.float32)).shape == (2, 2, 3)


class TestPictures:
    def test_normals(self):
        """Towards the viewer is the usual light blue; no surface is black."""
        normals = np.float32([[[0, 0, 1], [0, 0, 0]]])
        np.testing.assert_array_equal(picture_normals(normals), [[[128, 128, 255], [0, 0, 0]]])

    def test_mid_grey(self):
        """0 of a signed map, 1 of a gain, 1 of an albedo."""
        for picture, value in ((picture_signed, 0), (picture_gain, 1), (picture_albedo, 1)):
            np.testing.assert_array_equal(picture(np.full((1, 1, 3), value, np.float32)), 128)

    def test_depth(self):
        """White is nearest, black is no surface; without any surface all is black, and one depth is no error."""
        assert picture_depth(np.float32([[0, -5, 5]]))[0, :, 0].tolist() == [0, 38, 255]
        assert not picture_depth(np.zeros((2, 2), np.float32)).any()
        assert picture_depth(np.full((2, 2), 3, np.float32)).any()
