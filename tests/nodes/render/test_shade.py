"""Shading under a scene: modes, exposure and hard cases."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapes import half_ball, surface_with

from graphface.nodes.color import decode_srgb
from graphface.nodes.render.samples import samples
from graphface.nodes.render.shade import shade
from graphface.nodes.types import (
    DirectionalLight,
    HarmonicLight,
    Image,
    Scene,
)

NORMALS = half_ball(31)
COVERED = NORMALS.any(axis=2)
MASK = COVERED.astype(np.float32)
OLD = (0.5 + 0.1 * NORMALS[..., 0]) * MASK


def photo(encoding="srgb"):
    return Image(np.full((*MASK.shape, 3), 0.5, np.float32), encoding=encoding)


def shaded(scene, encoding="srgb", old=OLD, mask=MASK, normals=NORMALS):
    old = old.astype(np.float32)
    return shade(samples(surface_with(normals), old, mask, photo(encoding)), scene, old)


class TestModes:
    @pytest.mark.parametrize("encoding", ["srgb", "linear"])
    @pytest.mark.parametrize("scene", [Scene(mode="add"), Scene(mode="mix", mix=0, ambient=1)])
    def test_nothing_new_keeps_the_shading(self, encoding, scene):
        """Adding no light, or mixing in none, returns the estimated shading."""
        np.testing.assert_allclose(shaded(scene, encoding), OLD, atol=1e-5)

    def test_replace_forgets_the_old_pattern(self):
        """Pure ambient light shades evenly."""
        values = shaded(Scene(ambient=1))[COVERED]
        np.testing.assert_allclose(values, values[0], rtol=1e-5)

    def test_full_mix_is_replace(self):
        """The two ends of the mixture are the two modes."""
        lights = (DirectionalLight(azimuth=40),)
        mixed, replaced = shaded(Scene(mode="mix", mix=1, lights=lights)), shaded(Scene(lights=lights))
        np.testing.assert_allclose(mixed, replaced, atol=1e-5)

    def test_adding_brightens(self):
        """Light only ever adds."""
        lights = (DirectionalLight(azimuth=40),)
        assert (shaded(Scene(mode="add", lights=lights))[COVERED] >= OLD[COVERED] - 1e-5).all()


class TestExposure:
    @pytest.mark.parametrize("encoding", ["srgb", "linear"])
    def test_keep_mean_keeps_the_face_as_bright(self, encoding):
        """The mean linear shading over the face is that of the photo, times `exposure`."""
        linear = decode_srgb if encoding == "srgb" else np.asarray
        scene = Scene(lights=(DirectionalLight(azimuth=-50, intensity=7),), ambient=0.2, exposure=0.5)
        new = shaded(scene, encoding)
        assert linear(new[COVERED]).mean() == pytest.approx(
            0.5 * linear(OLD[COVERED].astype(np.float32)).mean(), rel=1e-3
        )

    def test_without_it_irradiance_is_as_written(self):
        """Ambient 1 without keep_mean is the photo's mean; 2 is twice that."""
        one, two = (shaded(Scene(ambient=a, keep_mean=False), "linear") for a in (1, 2))
        np.testing.assert_allclose(one[COVERED], OLD[COVERED].mean(), rtol=1e-4)
        np.testing.assert_allclose(two, 2 * one, rtol=1e-5)

    def test_a_black_scene_stays_black(self):
        """No light is not scaled up to something."""
        assert not shaded(Scene()).any()

    def test_nearly_no_light_stays_dark(self):
        """Below the floor brightness goes down with the light, without a jump."""
        dim, dimmer = (shaded(Scene(ambient=a), "linear")[COVERED].mean() for a in (1e-3, 1e-4))
        assert 0 < dimmer < dim < 0.1


class TestLights:
    @settings(max_examples=60, deadline=None)
    @given(
        st.floats(-360, 360),
        st.floats(-90, 90),
        st.floats(0, 90),
        st.floats(0, 1e6),
        st.lists(st.floats(-1e3, 1e3), min_size=4, max_size=4),
    )
    def test_any_light_is_finite_and_not_negative(self, azimuth, elevation, size, intensity, coefficients):
        """Grazing, behind, enormous, or an SH light that is mostly negative."""
        lights = (
            DirectionalLight(azimuth=azimuth, elevation=elevation, size=size, intensity=intensity),
            HarmonicLight(coefficients=tuple(coefficients)),
        )
        for keep in (True, False):
            new = shaded(Scene(lights=lights, keep_mean=keep))
            assert np.isfinite(new).all()
            assert new.min() >= 0


class TestHardCases:
    @pytest.mark.parametrize("encoding", ["srgb", "linear"])
    def test_black_photo(self, encoding):
        """A face without light has no unit to measure light in: it stays black."""
        assert not shaded(Scene(ambient=1), encoding, old=OLD * 0).any()

    def test_empty_mask(self):
        """Without a mask the whole surface sets the unit."""
        assert np.isfinite(shaded(Scene(ambient=1), mask=MASK * 0)).all()

    def test_no_surface(self):
        """Nothing to shade: zeros."""
        empty = shaded(Scene(ambient=1), normals=NORMALS * 0)
        assert not empty.any()
