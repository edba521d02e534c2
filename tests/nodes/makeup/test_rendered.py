"""The painted face before its details."""

import numpy as np

from graphface.nodes.makeup.rendered import rendered
from graphface.nodes.types import Image


def test_albedo_times_shading_in_range():
    """render(rho, F, theta), within what a picture can show; alpha comes from the photo."""
    alpha = np.full((2, 2), 0.5, np.float32)
    photo = Image(np.zeros((2, 2, 3), np.float32), alpha=alpha)
    albedo = np.full((2, 2, 3), (0.5, 1, 2), np.float32)
    picture = rendered(photo, albedo, np.full((2, 2), 0.8, np.float32))
    np.testing.assert_allclose(picture.pixels[0, 0], (0.4, 0.8, 1))
    np.testing.assert_array_equal(picture.alpha, alpha)
