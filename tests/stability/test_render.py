"""Lights, shadows and meshes that are hard: finite, in range, monotone in intensity, additive."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from graphface.nodes.blend.recombine import recombine
from graphface.nodes.detail.split import split
from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.masks.face import face
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.render.fitted_head import fitted_head
from graphface.nodes.render.samples import samples
from graphface.nodes.render.shade import shade
from graphface.nodes.render.shadow_maps import shadow_maps
from graphface.nodes.render.spread import spread
from graphface.nodes.render.surroundings import surroundings
from graphface.nodes.scatter.screen_space import screen_space
from graphface.nodes.sh.fit import fit as fit_light
from graphface.nodes.sh.render import render as render_light
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Image, Landmarks, Scene

pytestmark = pytest.mark.filterwarnings("ignore::graphface.fallback.GraphfaceWarning")

SUN = {"type": "directional", "azimuth": -50, "elevation": 20}
HARD = {
    "in the head": [{"type": "point", "position": [0, 0, -0.5]}],
    "at the middle": [{"type": "point", "position": [0, 0, 0]}],
    "on the nose": [{"type": "point", "position": [0, -0.05, 0.4]}],
    "spot without axis": [{"type": "spot", "position": [0, 0, 2], "target": [0, 0, 2]}],
    "closed spot": [{"type": "spot", "azimuth": 20, "cone": 0, "penumbra": 0}],
    "behind": [{"type": "directional", "azimuth": 180, "size": 0}],
    "lamp behind": [{"type": "point", "position": [0.5, 0, -4]}],
    "grazing": [{"type": "directional", "azimuth": 90, "size": 0, "shadow": "hard"}],
    "from above": [{"type": "directional", "elevation": 90, "shadow": "hard"}],
    "as large as the sky": [{"type": "directional", "size": 90}],
    "a million": [{**SUN, "intensity": 1e6}],
    "zero": [{**SUN, "intensity": 0}],
    "a hundred": [{**SUN, "azimuth": 3.6 * n - 180, "intensity": 0.02, "shadow": "hard"} for n in range(100)],
    "none": [],
    "negative harmonics": [{"type": "sh", "coefficients": [-5, -3, -2, 9]}],
}


def photo(side=96):
    x = np.linspace(1, 0.5, side)[None, :, None] * np.ones((side, 1, 1))
    return Image((x * np.array([0.8, 0.55, 0.45])).astype(np.float32))


def mesh():
    points = facemesh_topology().mean * (30, -30, 30) + (48, 44, 0)
    landmarks = Landmarks(points.astype(np.float32), "facemesh468")
    return facemesh(landmarks), landmarks


def shaded(scene, face_mesh=None, **settings):
    own, landmarks = mesh()
    whole = fitted_head(own) if face_mesh is None else face_mesh
    surface = rasterize(whole, photo())
    mask = face(surface, landmarks)
    estimated = render_light(fit_light(intensity(photo()).shading, surface.normals, mask).light, surface.normals)
    scene = Scene.coerce(scene)
    points = samples(surface, estimated, mask, photo(), whole)
    shadows = shadow_maps(whole, points, scene, **{"samples": 3, "resolution": 64, **settings})
    new = shade(points, scene, estimated, shadows)
    if scene.scatter:
        new = screen_space(new, estimated, surface, landmarks, photo(), scene)
    around = surroundings(mask, surface, landmarks)
    old, new = (spread(v, around) for v in (estimated, new))
    return old, new, landmarks


def relit(scene, **settings):
    old, new, landmarks = shaded(scene, **settings)
    parts = intensity(photo())
    detail = split(photo(), parts.albedo, old, landmarks)
    return recombine(photo(), parts.albedo, new, detail).pixels


class TestHardLights:
    @pytest.mark.parametrize("keep_mean", [True, False])
    @pytest.mark.parametrize("name", HARD)
    def test_finite_and_in_range(self, name, keep_mean):
        """Every light leaves a picture a picture."""
        for mode in ("replace", "add"):
            out = relit({"lights": HARD[name], "keep_mean": keep_mean, "mode": mode, "scatter": 0.05})
            assert np.isfinite(out).all()
            assert out.min() >= -1e-6
            assert out.max() <= 1 + 1e-6

    @pytest.mark.parametrize("kind", ["directional", "point", "spot"])
    def test_monotone_in_intensity(self, kind):
        """More light makes no pixel darker, up to a million."""
        outs = [
            relit({"ambient": 0.1, "keep_mean": False, "lights": [{"type": kind, "azimuth": -50, "intensity": i}]})
            for i in (0, 0.1, 1, 10, 1e6)
        ]
        for dim, bright in pairwise(outs):
            assert (bright >= dim - 1e-5).all()

    @pytest.mark.parametrize("kind", ["directional", "point", "spot"])
    def test_two_half_lights_are_one(self, kind):
        """Shadows, cones and scattering add up like light does."""
        lamp = {"type": kind, "azimuth": -50, "elevation": 20}
        one, two = (
            relit({"ambient": 0.1, "scatter": 0.05, "lights": lights})
            for lights in ([lamp], [{**lamp, "intensity": 0.5}] * 2)
        )
        np.testing.assert_allclose(one, two, atol=1e-4)

    def test_a_degree_is_a_small_step(self):
        """Turning a light with shadows by half a degree moves no pixel far, around the whole head."""
        for azimuth in (-100, -60, 0, 45, 89.5):
            one, two = (
                relit({"ambient": 0.2, "lights": [{**SUN, "azimuth": a}]}, samples=12) for a in (azimuth, azimuth + 0.5)
            )
            assert np.abs(one - two).max() < 0.06


class TestHardMeshes:
    def test_triangles_without_area(self):
        """Half of the triangles collapsed: finite, in range."""
        own = fitted_head(mesh()[0])
        triangles = own.triangles.copy()
        triangles[::2, 1] = triangles[::2, 0]
        _, new, _ = shaded({"lights": [SUN]}, replace(own, triangles=triangles))
        assert np.isfinite(new).all()
        assert new.min() >= 0

    @pytest.mark.parametrize("resolution", [1, 2, 7])
    def test_a_map_of_one_texel(self, resolution):
        """Too coarse a map shows less shadow, not a wrong one: close to no shadow at all."""
        _, coarse, _ = shaded({"keep_mean": False, "lights": [SUN]}, resolution=resolution)
        _, without, _ = shaded({"keep_mean": False, "lights": [{**SUN, "shadow": "none"}]})
        assert np.isfinite(coarse).all()
        assert (coarse <= without + 1e-3).all()
        if resolution == 1:
            np.testing.assert_allclose(coarse, without, atol=0.02)
