"""The photo's own cast shadow in the estimated shading."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import half_ball

from graphface.nodes.harmonics import ambient
from graphface.nodes.sh.render import render
from graphface.nodes.sh.shadowed import shadowed
from graphface.nodes.types import Lighting
from graphface.testing import check_node

NORMALS = half_ball()
MASK = NORMALS.any(axis=2).astype(np.float32)
SIDE = Lighting(np.float32([2.0, 0.2, 0.6, 1.0]))
SHADOW = np.zeros_like(MASK)
SHADOW[8:16, 19:24] = 1


def photographed(light, missing):
    """The shading of a ball whose shadow lacks a share of what the light gives beyond its least."""
    full = render(light, NORMALS, floor=0.05)
    return full, full - missing * SHADOW * np.maximum(full - 0.05, 0)


class TestShadowed:
    @pytest.mark.parametrize("missing", [0.3, 0.6, 1.0])
    def test_measures_the_depth(self, missing):
        """A shadow gets as dark as it is in the photo, whatever the photo's exposure."""
        full, seen = photographed(SIDE, missing)
        for exposure in (0.5, 1, 1.6):
            found = shadowed(full, SIDE, SHADOW, seen * np.float32(exposure), MASK)
            np.testing.assert_allclose(found, seen, atol=0.02)

    def test_no_evidence(self):
        """Where the photo is as bright as without a shadow, there is none."""
        full, _ = photographed(SIDE, 0)
        np.testing.assert_allclose(shadowed(full, SIDE, SHADOW, full, MASK), full, atol=1e-6)

    def test_strength_is_continuous(self):
        """From no shadow to all of it in even steps."""
        full, seen = photographed(SIDE, 0.8)
        means = [shadowed(full, SIDE, SHADOW, seen, MASK, strength=s).mean() for s in np.linspace(0, 1, 5)]
        np.testing.assert_allclose(np.diff(means), np.diff(means).mean(), rtol=1e-3)

    def test_nothing_to_do(self):
        """Without a shadow, without strength and under light from everywhere the shading stays the same array."""
        full, seen = photographed(SIDE, 0.8)
        assert shadowed(full, SIDE, 0 * SHADOW, seen, MASK) is full
        assert shadowed(full, SIDE, SHADOW, seen, MASK, strength=0.0) is full
        assert shadowed(full, ambient(0.5), SHADOW, seen, MASK) is full
        assert shadowed(full, SIDE, SHADOW, seen, 0 * MASK) is full

    def test_only_in_the_shadow(self):
        """Where no shadow is nothing changes, and nowhere is it darker than the floor."""
        full, seen = photographed(SIDE, 1.0)
        found = shadowed(full, SIDE, SHADOW, seen, MASK)
        np.testing.assert_array_equal(found[SHADOW == 0], full[SHADOW == 0])
        assert found[MASK > 0].min() >= 0.05 - 1e-6

    def test_colored_light(self):
        """A light per channel loses each channel's own part."""
        light = Lighting(np.repeat(SIDE.coefficients[:, None], 3, axis=1) * np.float32([1, 0.8, 0.5]))
        full = render(light, NORMALS, floor=0.05)
        _, seen = photographed(SIDE, 1.0)
        found = shadowed(full, light, SHADOW, seen, MASK)
        assert found.shape == full.shape
        assert (found[SHADOW > 0] < full[SHADOW > 0]).any(axis=0).all()

    @settings(deadline=None, max_examples=40)
    @given(
        st.lists(st.floats(-1e6, 1e6, width=32), min_size=4, max_size=4),
        st.sampled_from([0.0, 1.0, np.nan, np.inf, -np.inf, 1e30, -5.0]),
    )
    def test_any_light_and_photo(self, coefficients, value):
        """Negative and huge lights, photos without numbers: finite, and never brighter than the estimate."""
        light = Lighting(np.float32(coefficients))
        full = render(light, NORMALS, floor=0.05)
        found = shadowed(full, light, SHADOW, np.full_like(full, value), MASK)
        assert np.isfinite(found).all()
        assert (found <= full).all()

    def test_is_a_node(self):
        """It is pure and deterministic, and survives what its ports may carry."""
        full, seen = photographed(SIDE, 0.7)
        check_node(shadowed, full, SIDE, SHADOW, seen, MASK)
