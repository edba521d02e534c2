"""Values of relighting."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import (
    Shadows,
)


class TestShadows:
    def test_picture(self):
        """The maps side by side; without a light, white."""
        shadows = Shadows((0, 2), np.float32([[[0, 1]], [[1, 0.5]]]))
        np.testing.assert_array_equal(Shadows.picture(shadows)[0, :, 0], [0, 255, 255, 128])
        assert (Shadows.picture(Shadows((), np.ones((0, 2, 3), np.float32))) == 255).all()
