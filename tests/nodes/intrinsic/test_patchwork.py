"""Every intrinsic method on a patchwork under a smooth light, where the answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.intrinsic.bell2014 import bell2014
from graphface.nodes.intrinsic.bilateral import bilateral
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.intrinsic.l1_flatten import l1_flatten
from graphface.nodes.intrinsic.log_tv import log_tv
from graphface.nodes.intrinsic.multiscale_retinex import multiscale_retinex
from graphface.nodes.intrinsic.retinex import retinex
from graphface.testing import check_node

QUALITY = {
    intensity: 0.17,
    multiscale_retinex: 0.08,
    bilateral: 0.075,
    retinex: 0.05,
    l1_flatten: 0.085,
    log_tv: 0.05,
    bell2014: 0.035,
}
"""Mean error of the shading over its mean, after the best gain: as measured, plus a fifth."""


def shading_error(made, truth):
    gain = (made * truth).sum() / np.square(made).sum()
    return float(np.abs(gain * made - truth).mean() / truth.mean())


@pytest.mark.parametrize("method", QUALITY, ids=lambda m: m.__name__)
class TestOnAPatchwork:
    def test_shading_error(self, method, patchwork):
        """No worse than in the table."""
        case = patchwork()
        assert shading_error(method(case.photo).shading, case.shading) < QUALITY[method]

    def test_product_is_the_photo(self, method, patchwork):
        """albedo * shading gives the photo back within 1e-5."""
        photo = patchwork().photo
        parts = method(photo)
        np.testing.assert_allclose(parts.albedo * parts.shading[..., None], photo.pixels, atol=1e-5)

    def test_shading_has_the_mean_of_the_intensity_over_the_mask(self, method, patchwork):
        """Every method chooses the free scale alike, so that a swap keeps the unit of light."""
        case = patchwork()
        mask = np.zeros(case.shading.shape, np.float32)
        mask[20:90, 30:100] = 1
        parts = method(case.photo, mask)
        inside = mask > 0
        assert parts.shading[inside].mean() == pytest.approx(case.photo.pixels[inside].mean(), rel=0.02)

    def test_keeps_the_promises_of_an_operator(self, method, patchwork):
        """Types, purity, determinism, and finite values from a photo with holes."""
        check_node(method, patchwork(size=64).photo)
