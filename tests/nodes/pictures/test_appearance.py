"""Albedo and shading, offset and gain."""

from __future__ import annotations

import numpy as np

from graphface.nodes.pictures.appearance import draw_detail_map, draw_intrinsic
from graphface.nodes.types import DetailMap, Intrinsic
from graphface.values.picture import View

ZERO, ONE = np.zeros((2, 2, 3), np.float32), np.ones((2, 2, 3), np.float32)


def test_no_detail_is_mid_grey():
    """For an offset alone, and for offset and gain beside each other."""
    np.testing.assert_array_equal(draw_detail_map(DetailMap(ZERO), View()).pixels, np.full((2, 2, 3), 128))
    both = draw_detail_map(DetailMap(ZERO, ONE), View())
    np.testing.assert_array_equal(both.pixels, np.full((2, 4, 3), 128))
    np.testing.assert_array_equal(both.data[0, :, 0], [0, 0, 1, 1])


def test_intrinsic():
    """Albedo left, shading right, each by its own scale."""
    picture = draw_intrinsic(Intrinsic(ONE, np.full((2, 2), 0.25, np.float32)), View())
    assert picture.pixels[0, :, 0].tolist() == [128, 128, 64, 64]
    assert picture.note == "albedo: mid grey is 1, white 2, black 0; shading: black is 0, white 1"
