"""Large steps are reflectance, small ones shading."""

from __future__ import annotations

import numpy as np

from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.intrinsic.retinex import retinex
from graphface.nodes.types import (
    Image,
)


class TestRetinex:
    def test_small_shadows_go_to_the_albedo_of_retinex(self, patchwork):
        """The paper's complaint: a hard little shadow is a change of reflectance to it, and of shading to intensity."""
        case = patchwork(4)
        shadowed = case.photo.pixels.copy()
        shadowed[40:46, 40:46] *= 0.4
        photo = case.photo.with_pixels(shadowed)
        drop = {m: m(photo).albedo[42, 42].mean() / m(case.photo).albedo[42, 42].mean() for m in (intensity, retinex)}
        assert drop[retinex] < 0.6
        assert drop[intensity] > 0.9

    def test_a_gentle_ramp_is_shading(self):
        """Below both thresholds the albedo is flat."""
        ramp = np.repeat(np.linspace(0.3, 0.8, 64, dtype=np.float32)[None, :, None], 3, axis=2)
        albedo = retinex(Image(np.repeat(ramp, 16, axis=0))).albedo
        np.testing.assert_allclose(albedo, albedo.mean(), rtol=0.01)
