"""The large-scale layer of a bilateral filter."""

from __future__ import annotations

import numpy as np

from graphface.nodes.intrinsic.bilateral import bilateral


def shading_error(made, truth):
    gain = (made * truth).sum() / np.square(made).sum()
    return float(np.abs(gain * made - truth).mean() / truth.mean())


class TestBilateral:
    def test_separates_by_size(self, patchwork):
        """Patches larger than the filter stay in the shading."""
        small, large = patchwork(32), patchwork(4)
        assert shading_error(bilateral(small.photo).shading, small.shading) < 0.08
        assert shading_error(bilateral(large.photo).shading, large.shading) > 0.08
