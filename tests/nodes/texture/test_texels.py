"""Texture coordinates and texels."""

import numpy as np

from graphface.nodes.texture.texels import sampled, texels


def test_corners_of_the_texture():
    """v points up: (0, 1) is the upper left corner of the upper left texel, (1, 0) the lower right one of the last."""
    uv = np.float32([[[0, 1], [1, 0], [0.5, 0.5]]])
    np.testing.assert_allclose(texels(uv, 4), [[[-0.5, -0.5], [3.5, 3.5], [1.5, 1.5]]])


def test_samples_between_texels():
    """Values are interpolated bilinearly; beyond the border they repeat."""
    values = np.float32([[0, 1], [2, 3]])
    places = np.float32([[[0.5, 0.5], [1, 0], [9, 9]]])
    np.testing.assert_allclose(sampled(values, places), [[1.5, 1, 3]])
