"""A ramp without a kink."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from graphface.nodes.smoothstep import smoothstep


class TestSmoothstep:
    @given(st.floats(-10, 10, width=32), st.floats(-10, 10, width=32))
    def test_is_monotone_in_zero_to_one(self, one, other):
        """0 and 1 beyond the ends."""
        low, high = smoothstep(np.float32(sorted([one, other])))
        assert 0 <= low <= high + 1e-6 <= 1 + 2e-6

    def test_slopes(self):
        """None at the ends, one and a half in the middle."""
        slope = np.diff(smoothstep(np.linspace(0, 1, 1001))) * 1000
        np.testing.assert_allclose(slope[[0, 500, -1]], [0, 1.5, 0], atol=0.01)
