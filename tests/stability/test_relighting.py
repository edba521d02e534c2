"""Relighting, every stage but the landmark network, on photos and faces that are hard.

The landmarks are FaceMesh's mean shape put where the case wants it, so nothing here needs network weights.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.blend.recombine import recombine
from graphface.nodes.detail.additive import additive as additive_detail
from graphface.nodes.detail.multiplicative import multiplicative as multiplicative_detail
from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.masks.face import face
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.render.background import background
from graphface.nodes.render.samples import samples
from graphface.nodes.render.shade import shade
from graphface.nodes.render.spread import spread
from graphface.nodes.render.surroundings import surroundings
from graphface.nodes.sh.fit import fit as fit_light
from graphface.nodes.sh.render import render as render_light
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Image, Landmarks, Scene

pytestmark = pytest.mark.filterwarnings("ignore::graphface.fallback.GraphfaceWarning")

SCENES = {
    "no light": {},
    "ambient": {"ambient": 1},
    "left": {"ambient": 0.3, "lights": [{"type": "directional", "azimuth": -55}]},
    "grazing": {"lights": [{"type": "directional", "azimuth": 90, "size": 0}]},
    "behind": {"lights": [{"type": "directional", "azimuth": 180, "size": 0}]},
    "enormous": {"lights": [{"type": "directional", "intensity": 1e6}], "keep_mean": False},
    "added": {"mode": "add", "lights": [{"type": "directional", "azimuth": 60, "color": [1, 0.2, 0]}]},
    "colored": {"ambient": [0.2, 0.3, 0.9], "lights": [{"type": "sh", "preset": "left"}]},
}

PHOTOS = {
    "black": lambda rng, shape: np.zeros(shape),
    "white": lambda rng, shape: np.ones(shape),
    "flat": lambda rng, shape: np.full(shape, (0.8, 0.5, 0.4)),
    "one channel": lambda rng, shape: np.full(shape, (1.0, 0.0, 0.0)),
    "salt and pepper": lambda rng, shape: (rng.random(shape) > 0.5).astype(float),
    "noise at 1/255": lambda rng, shape: rng.integers(0, 2, shape) / 255,
}


def landmarks(center, interocular, yaw=0.0):
    turn = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    points = facemesh_topology().mean @ turn.T * (interocular, -interocular, interocular) + (*center, 0)
    return Landmarks(points.astype(np.float32), "facemesh468")


def relit(pixels, points, scene, method=additive_detail):
    photo = Image(np.asarray(pixels, np.float32))
    scene = Scene.coerce(scene)
    surface = rasterize(facemesh(points), photo)
    mask = face(surface, points)
    parts = intensity(photo)
    estimated = render_light(fit_light(parts.shading, surface.normals, mask).light, surface.normals)
    around = surroundings(mask, surface, points)
    old = spread(estimated, around)
    new = spread(shade(samples(surface, estimated, mask, photo), scene, estimated), around)
    mixed = background(old, new, mask, points, scene)
    return recombine(photo, parts.albedo, mixed, method(photo, parts.albedo, old)).pixels


def skin(height=96, width=80):
    """A smooth picture, darker to the right."""
    x = np.linspace(1, 0.4, width)[None, :, None] * np.ones((height, 1, 1))
    return x * np.array([0.8, 0.55, 0.45])


class TestHardPhotos:
    @pytest.mark.parametrize("photo", PHOTOS)
    @pytest.mark.parametrize("scene", SCENES)
    @pytest.mark.parametrize("method", [additive_detail, multiplicative_detail])
    def test_finite_and_in_range(self, photo, scene, method, rng):
        """Every photo under every light stays a picture."""
        pixels = PHOTOS[photo](rng, (96, 80, 3))
        out = relit(pixels, landmarks((40, 48), 30), SCENES[scene], method)
        assert np.isfinite(out).all()
        assert out.min() >= -1e-6
        assert out.max() <= 1 + 1e-6

    @pytest.mark.parametrize("photo", PHOTOS)
    def test_identity(self, photo, rng):
        """An unchanged light returns each of them."""
        pixels = PHOTOS[photo](rng, (96, 80, 3))
        out = relit(pixels, landmarks((40, 48), 30), {"mode": "add"})
        np.testing.assert_allclose(out, pixels, atol=1 / 255 / 10)

    def test_black_stays_black(self):
        """There is no colour to light."""
        assert not relit(np.zeros((96, 80, 3)), landmarks((40, 48), 30), SCENES["left"]).any()


class TestHardFaces:
    @settings(max_examples=40, deadline=None)
    @given(
        st.floats(-60, 140), st.floats(-60, 150), st.sampled_from([0.0, 0.05, 1, 5, 30, 200, 2000]), st.floats(-2, 2)
    )
    def test_any_place_size_and_turn(self, x, y, interocular, yaw):
        """Outside the frame, one pixel, larger than the picture, in profile: finite and in range."""
        out = relit(skin(), landmarks((x, y), interocular, yaw), SCENES["left"])
        assert np.isfinite(out).all()
        assert out.min() >= -1e-6
        assert out.max() <= 1 + 1e-6

    def test_a_picture_of_one_pixel(self):
        """1 x 1 works like any other."""
        assert relit(np.full((1, 1, 3), 0.5), landmarks((0, 0), 1), SCENES["left"]).shape == (1, 1, 3)


class TestSmallChanges:
    def test_of_the_photo(self, rng):
        """Noise of 1/255 on the photo comes out no more than tripled."""
        points = landmarks((40, 48), 30)
        noisy = skin() + rng.integers(-1, 2, (96, 80, 3)) / 255
        difference = relit(noisy, points, SCENES["left"]) - relit(skin(), points, SCENES["left"])
        assert np.abs(difference).max() < 3 / 255

    def test_of_the_landmarks(self):
        """A tenth of a pixel on a face of 120 moves no value by more than a few levels: no pixel pops."""
        one, two = (relit(skin(384, 320), landmarks((160 + d, 192), 120), SCENES["left"]) for d in (0, 0.1))
        assert np.abs(one - two).max() < 5 / 255

    def test_of_the_light(self):
        """Grazing light is close to light a degree before grazing."""
        one, two = (
            relit(skin(), landmarks((40, 48), 30), {"lights": [{"type": "directional", "azimuth": a}]})
            for a in (89, 90)
        )
        assert np.abs(one - two).max() < 0.03
