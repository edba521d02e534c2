"""No detail map."""

from __future__ import annotations

import numpy as np

from graphface.nodes.blend.recombine import recombine
from graphface.nodes.detail.none import none
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.types import (
    Image,
)


class TestNone:
    def test_leaves_the_rendering(self, rng):
        """Without detail, what is left is albedo times shading."""
        photo = Image(rng.uniform(0.3, 0.7, (6, 5, 3)).astype(np.float32))
        albedo = intensity(photo).albedo
        shading = np.full((6, 5), 0.5, np.float32)
        bare = recombine(photo, albedo, shading, none(photo, albedo, shading), shoulder=0)
        np.testing.assert_allclose(bare.pixels, np.clip(albedo * 0.5, 0, 1), atol=1e-5)
