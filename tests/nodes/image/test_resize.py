"""Pictures at another size."""

from __future__ import annotations

import numpy as np
import pytest
from pictures import smooth

from graphface.nodes.image.resize import resize
from graphface.nodes.types import Image


class TestResize:
    @pytest.mark.parametrize(("size", "expected"), [((40, 60), (20, 30)), ((60, 40), (30, 20)), ((1, 600), (1, 30))])
    def test_long_side(self, size, expected):
        """The longer side has `long_side` pixels, the other follows and has at least one."""
        assert resize(Image(smooth(*size)), long_side=30).pixels.shape[:2] == expected

    def test_small_pictures_are_left(self):
        """A picture that already fits is the same object."""
        image = Image(smooth())
        assert resize(image, long_side=100) is image

    def test_enlarge(self):
        """A smaller picture is enlarged with `enlarge`; alpha stays in 0..1."""
        image = Image(smooth(), (smooth(channels=1)[..., 0] > 0.5).astype(np.float32))
        large = resize(image, long_side=120, enlarge=True)
        assert large.pixels.shape == (80, 120, 3)
        assert large.alpha is not None
        assert 0 <= large.alpha.min() <= large.alpha.max() <= 1

    def test_averages_light_not_code_values(self):
        """Half black, half white is half the light: sRGB 0.735, not 0.5."""
        stripes = np.zeros((2, 64, 3), np.float32)
        stripes[:, ::2] = 1
        np.testing.assert_allclose(resize(Image(stripes), long_side=32).pixels, 0.7354, atol=1e-3)
