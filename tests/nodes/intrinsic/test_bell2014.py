"""Few reflectances."""

from __future__ import annotations

import numpy as np

from graphface.nodes.intrinsic.bell2014 import bell2014


def shading_error(made, truth):
    gain = (made * truth).sum() / np.square(made).sum()
    return float(np.abs(gain * made - truth).mean() / truth.mean())


class TestBell2014:
    def test_few_reflectances_is_what_bell_assumes(self, patchwork):
        """With as many colors as patches it loses its advantage; with six it is nearly exact."""
        few, many = patchwork(8, 6), patchwork(8, 64)
        assert shading_error(bell2014(few.photo).shading, few.shading) < 0.01
        assert shading_error(bell2014(many.photo).shading, many.shading) > 0.05

    def test_runs_are_the_same(self, patchwork):
        """There are no random numbers in it."""
        photo = patchwork(size=64).photo
        np.testing.assert_array_equal(bell2014(photo, rounds=2).shading, bell2014(photo, rounds=2).shading)
