"""Maps by fixed scales."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.pictures.maps import (
    albedo_bytes,
    depth_bytes,
    draw_coordinates,
    draw_depth,
    draw_detail,
    draw_gain,
    draw_shading,
    normals_bytes,
    signed_bytes,
)
from graphface.values.picture import View


class TestBytes:
    def test_normals(self):
        """Towards the viewer is the usual light blue; no surface is black."""
        normals = np.float32([[[0, 0, 1], [0, 0, 0]]])
        np.testing.assert_array_equal(normals_bytes(normals), [[[128, 128, 255], [0, 0, 0]]])

    def test_mid_grey(self):
        """0 of a signed map, 1 of a gain or an albedo."""
        for drawn, value in ((signed_bytes, 0), (albedo_bytes, 1)):
            np.testing.assert_array_equal(drawn(np.full((1, 1, 3), value, np.float32)), 128)

    def test_depth(self):
        """White is nearest, black is no surface; without any surface all is black, and one depth is no error."""
        assert depth_bytes(np.float32([[0, -5, 5]]))[0, :, 0].tolist() == [0, 38, 255]
        assert not depth_bytes(np.zeros((2, 2), np.float32)).any()
        assert depth_bytes(np.full((2, 2), 3, np.float32)).any()


class TestNotes:
    def test_depth(self):
        """Nearest and farthest in pixels."""
        note = draw_depth(np.float32([[0, -5, 5]]), View()).note
        assert note == "white is near, 5 px, dark is far, -5 px; black: no surface"

    @pytest.mark.parametrize(("draw", "beyond"), [(draw_detail, 0.7), (draw_gain, 3), (draw_shading, 1.5)])
    def test_beyond_the_scale(self, draw, beyond):
        """The share of the pixels that the scale cannot show is told."""
        values = np.zeros((10, 10, 3), np.float32)
        assert "beyond" not in draw(values, View()).note
        values[0] = beyond
        assert "10.0% of the pixels lie beyond" in draw(values, View()).note

    def test_residual(self):
        """A signed shading is drawn around mid grey."""
        picture = draw_shading(np.float32([[0, -0.25]]), View())
        assert picture.pixels[0, :, 0].tolist() == [128, 64]
        assert picture.note.startswith("mid grey is 0")


def test_coordinates():
    """u is red and v green; where there is no face, neither."""
    at = np.float32([[[0.53, 0.03], [0.03, 0.53], [-1, -1]]])
    pixels = draw_coordinates(at, View()).pixels[0].astype(int)
    assert pixels[0, 0] > pixels[0, 1]
    assert pixels[1, 1] > pixels[1, 0]
    assert pixels[2].tolist() == [64, 64, 64]
