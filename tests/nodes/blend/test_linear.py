"""Alpha blending."""

import numpy as np
from portraits import eyes_apart

from graphface.nodes.blend.linear import linear
from graphface.nodes.types import Image


def test_mixes_by_the_mask():
    """A quarter of the layer and three quarters of the base; alpha is the base's."""
    base, layer = (Image(np.full((2, 2, 3), v, np.float32), alpha=np.full((2, 2), v, np.float32)) for v in (0.2, 0.6))
    blended = linear(base, layer, np.full((2, 2), 0.25, np.float32), eyes_apart(40))
    np.testing.assert_allclose(blended.pixels, 0.3, rtol=1e-6)
    np.testing.assert_array_equal(blended.alpha, base.alpha)
