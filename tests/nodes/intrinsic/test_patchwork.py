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
        """No worse than the table says."""
        case = patchwork()
        assert shading_error(method(case.photo).shading, case.shading) < QUALITY[method]

    def test_product_is_the_photo(self, method, patchwork):
        """albedo * shading gives the photo back within 1e-5."""
        photo = patchwork().photo
        parts = method(photo)
        np.testing.assert_allclose(parts.albedo * parts.shading[..., None], photo.pixels, atol=1e-5)

    def test_shading_has_the_mean_of_the_intensity_over_the_mask(self, method, patchwork):
        """The free scale is settled the same way by every method, so that swapping one keeps the unit of light."""
        case = patchwork()
        mask = np.zeros(case.shading.shape, np.float32)
        mask[20:90, 30:100] = 1
        parts = method(case.photo, mask)
        inside = mask > 0
        assert parts.shading[inside].mean() == pytest.approx(case.photo.pixels[inside].mean(), rel=0.02)

    def test_keeps_the_promises_of_an_operator(self, method, patchwork):
        """Types, purity, determinism, and finite values from a photo with holes."""
        check_node(method, patchwork(size=64).photo)


class TestDivisionOfLabour:
    """What tells the methods apart."""

    def test_few_reflectances_is_what_bell_assumes(self, patchwork):
        """With as many colors as patches it loses its advantage; with six it is nearly exact."""
        few, many = patchwork(8, 6), patchwork(8, 64)
        assert shading_error(bell2014(few.photo).shading, few.shading) < 0.01
        assert shading_error(bell2014(many.photo).shading, many.shading) > 0.05

    @pytest.mark.parametrize("method", [bilateral, log_tv])
    def test_size_is_what_the_filters_assume(self, method, patchwork):
        """Patches larger than the filter's reach stay in the shading."""
        small, large = patchwork(32), patchwork(4)
        assert shading_error(method(small.photo).shading, small.shading) < 0.08
        assert shading_error(method(large.photo).shading, large.shading) > 0.08

    def test_small_shadows_go_to_the_albedo_of_retinex(self, patchwork):
        """The paper's complaint: a hard little shadow is a change of reflectance to it, and of shading to intensity."""
        case = patchwork(4)
        shadowed = case.photo.pixels.copy()
        shadowed[40:46, 40:46] *= 0.4
        photo = case.photo.with_pixels(shadowed)
        drop = {m: m(photo).albedo[42, 42].mean() / m(case.photo).albedo[42, 42].mean() for m in (intensity, retinex)}
        assert drop[retinex] < 0.6
        assert drop[intensity] > 0.9
