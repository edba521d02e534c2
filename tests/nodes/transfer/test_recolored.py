"""A detail map in the colors of another albedo."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.transfer.recolored import recolored
from graphface.nodes.types import DetailMap


class TestRecolored:
    def test_equal_albedo(self, rng):
        """On skin of the same color, a map that is rho (s - SH) stays as it is."""
        rho, light = rng.random((4, 4, 3), np.float32) + 0.5, rng.standard_normal((4, 4, 1), np.float32)
        np.testing.assert_allclose(recolored(DetailMap(rho * light), rho, rho).offset, rho * light, rtol=1e-4)

    def test_equal_albedo_darker_than_the_floor(self, rng):
        """On skin of the same color any map stays as it is to the last bit, however dark the albedo."""
        rho, offset = (rng.random((4, 4, 3), np.float32) * np.float32(0.1) for _ in range(2))
        np.testing.assert_array_equal(recolored(DetailMap(offset), rho, rho).offset, offset)

    def test_takes_the_inputs_color(self):
        """The shadow of red lips on grey skin is grey."""
        red, skin = (np.full((2, 2, 3), c, np.float32) for c in ((2.6, 0.2, 0.2), (1.0, 1.0, 1.0)))
        got = recolored(DetailMap(-0.3 * red), red, skin).offset
        np.testing.assert_allclose(got, -0.3, rtol=1e-5)

    @settings(max_examples=50, deadline=None)
    @given(own=st.floats(0, 1e3, width=32), other=st.floats(0, 1e3, width=32))
    def test_black_is_not_divided_by(self, own, other):
        """Black albedos give finite detail: the floor bounds what is added."""
        ones = np.ones((1, 1, 3), np.float32)
        got = recolored(DetailMap(ones), ones * np.float32(other), ones * np.float32(own)).offset
        assert np.isfinite(got).all()
        assert (np.abs(got) <= 1 + 10.01 * abs(own - other)).all()
