"""Normals and cast shadows from the picture."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from portraits import landmarks_at, portrait, surface_of

from graphface.nodes.harmonics import ambient
from graphface.nodes.surface.normal_network import NormalWeights, shipped_weights
from graphface.nodes.surface.refined import refined
from graphface.nodes.types import Image, Lighting, Segmentation
from graphface.testing import check_node

LIGHT = Lighting(np.float32([2.0, 0.3, 0.8, -0.4]))


def domed(surface):
    """A surface with the normals of a sphere over the same pixels."""
    height, width = surface.coverage.shape
    y, x = np.mgrid[:height, :width].astype(np.float32)
    x, y = (x - width / 2) / width, (height / 2 - y) / height
    normals = np.dstack([x, y, np.sqrt(np.maximum(1 - x * x - y * y, 0.01))])
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    return replace(surface, normals=(normals * surface.coverage[..., None]).astype(np.float32))


def case(side=160, **more):
    photo, landmarks, _ = portrait(side, **more)
    surface = domed(surface_of(landmarks, (side, side)))
    return surface, photo, landmarks, surface.coverage, LIGHT


class TestRefined:
    def test_unit_normals_on_the_same_surface(self):
        """Normals change on the face and stay of unit length; the rest of the surface is what it was."""
        before, *others = case()
        after = refined(before, *others).surface
        on = before.coverage > 0
        np.testing.assert_allclose(np.linalg.norm(after.normals[on], axis=1), 1, atol=1e-4)
        assert not after.normals[~on].any()
        assert np.abs(after.normals - before.normals).max() > 1e-3
        assert after.coverage is before.coverage
        assert after.depth is before.depth

    def test_strength(self):
        """Without strength nothing is changed; with half of it about half."""
        before, *others = case()
        nothing = refined(before, *others, strength=0.0)
        assert nothing.surface is before
        assert not nothing.shadow.any()
        half, whole = (refined(before, *others, strength=s).surface.normals - before.normals for s in (0.5, 1.0))
        assert np.linalg.norm(half) == pytest.approx(np.linalg.norm(whole) / 2, rel=0.1)

    def test_hair_keeps_its_normals(self):
        """What lies far from hair is refined as it is without labels."""
        before, *others = case()
        hair = np.zeros_like(before.coverage)
        hair[:, :70] = 1
        free = refined(before, *others).surface.normals
        held = refined(before, *others, Segmentation(before.coverage, hair, 1 - before.coverage)).surface.normals
        np.testing.assert_allclose(held[:, :60], before.normals[:, :60], atol=1e-5)
        np.testing.assert_allclose(held[:, 110:], free[:, 110:], atol=1e-3)

    def test_fine_part(self):
        """The finer the part that is taken, the smaller the change."""
        before, *others = case()
        sizes = [
            np.abs(refined(before, *others, finer_than=s).surface.normals - before.normals).mean() for s in (0.03, 0.12)
        ]
        assert sizes[0] < sizes[1]

    def test_size_of_the_photo_matters_little(self):
        """Twice the pixels, the same normals."""
        small, large = (refined(*case(side, noise=0)).surface.normals for side in (160, 320))
        again = large.reshape(160, 2, 160, 2, 3).mean(axis=(1, 3))
        assert np.abs(again - small)[60:100, 60:100].mean() < 0.03

    def test_noise_of_one_level(self):
        """Noise of one 8-bit level hardly changes the normals."""
        surface, photo, *others = case()
        noise = np.random.default_rng(1).integers(-1, 2, photo.pixels.shape) / 255
        before = refined(surface, photo, *others).surface.normals
        after = refined(surface, photo.with_pixels(photo.pixels + noise), *others).surface.normals
        assert np.abs(after - before).mean() < 0.005

    @pytest.mark.parametrize("value", [0.0, 1.0, 0.4, np.nan, np.inf, -3.0, 1e30])
    def test_flat_pictures(self, value):
        """Black, white and impossible pictures give unit normals."""
        surface, photo, *others = case(80)
        found = refined(surface, photo.with_pixels(np.full_like(photo.pixels, value)), *others).surface.normals
        np.testing.assert_allclose(np.linalg.norm(found[surface.coverage > 0], axis=1), 1, atol=1e-4)

    @pytest.mark.parametrize("coefficients", [[0, 0, 0, 0], [-1, 0, 0, 0], [1e6, 0, 1e6, 0], [1e-9, 1, 0, 0]])
    def test_odd_lights(self, coefficients):
        """No light, a negative one and a huge one give finite normals."""
        *others, _ = case(80)
        assert np.isfinite(refined(*others, Lighting(np.float32(coefficients))).surface.normals).all()

    def test_colored_light(self):
        """A light per channel is taken as its mean."""
        *others, _ = case(80)
        grey, colored = LIGHT, Lighting(np.repeat(LIGHT.coefficients[:, None], 3, axis=1))
        np.testing.assert_allclose(
            refined(*others, grey).surface.normals, refined(*others, colored).surface.normals, atol=1e-5
        )

    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    @settings(deadline=None, max_examples=15)
    @given(st.integers(1, 60), st.integers(1, 60), st.floats(-90, 90), st.floats(0.01, 500), st.floats(-3.1, 3.1))
    def test_any_place(self, height, width, x, interocular, roll):
        """A photo of a pixel, a face cut by the frame, a speck or huge: finite normals."""
        photo = Image(np.random.default_rng(0).uniform(0, 1, (height, width, 3)).astype(np.float32))
        landmarks = landmarks_at(x, 20, interocular, roll)
        surface = surface_of(landmarks, (height, width))
        found = refined(surface, photo, landmarks, surface.coverage, ambient(0.5, 1))
        assert np.isfinite(found.surface.normals).all()
        assert 0 <= found.shadow.min() <= found.shadow.max() <= 1

    def test_no_face(self):
        """A surface that is nowhere keeps its normals, with a warning."""
        _, photo, *others = case(60)
        landmarks = landmarks_at(900, 900, 20)
        nowhere = surface_of(landmarks, (60, 60))
        with pytest.warns(match="no face"):
            found = refined(nowhere, photo, landmarks, *others[1:])
        assert found.surface is nowhere
        assert not found.shadow.any()

    def test_shadow_of_the_weights(self):
        """What the network calls shadow is shadow on the surface, up to the crop's rim, and nowhere else."""
        before, *others = case()
        said = {name: np.zeros_like(values) for name, values in shipped_weights().items()}
        said["out.bias"][12:] = 9
        shadow = refined(before, *others, weights=NormalWeights(said)).shadow
        assert shadow[70:90, 70:90].min() > 0.99
        assert not shadow[:, :4].any()
        assert shadow[before.coverage == 0].mean() < 0.05

    def test_is_a_node(self):
        """It is pure, deterministic and survives NaN."""
        check_node(refined, *case(60))

    def test_weights_of_the_users_own(self):
        """A network of zero weights changes nothing."""
        before, *others = case(80)
        zeros = NormalWeights({name: np.zeros_like(values) for name, values in shipped_weights().items()})
        np.testing.assert_allclose(refined(before, *others, weights=zeros).surface.normals, before.normals, atol=1e-5)
        assert not refined(before, *others, weights=zeros).shadow.any()
