"""Highlights of the new lights."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.render.samples import samples
from graphface.nodes.render.specular import specular
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import (
    Image,
    Landmarks,
    Scene,
)

PHOTO = Image(np.full((200, 160, 3), 0.5, np.float32))


def face_mesh(yaw=0.0, unit=50.0):
    turn = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    points = facemesh_topology().mean @ turn.T * (unit, -unit, unit) + (80, 80, 0)
    return facemesh(Landmarks(points.astype(np.float32), "facemesh468"))


class TestSpecular:
    MESH = face_mesh()
    SURFACE = rasterize(MESH, PHOTO)

    def shine(self, scene):
        estimated = 0.5 * self.SURFACE.coverage
        points = samples(self.SURFACE, estimated, self.SURFACE.coverage, PHOTO, self.MESH)
        return specular(points, scene, self.SURFACE.coverage)

    def test_lies_between_light_and_viewer(self):
        """A light from the left makes its highlight on the left half."""
        scene = Scene.coerce({"specular": 1, "lights": [{"type": "directional", "azimuth": -60}]})
        sums = self.shine(scene)[..., 0].sum(axis=0)
        assert sums[:80].sum() > 1.5 * sums[80:].sum()

    def test_ambient_light_makes_none(self):
        """Nor does spherical-harmonic light."""
        assert not self.shine(
            Scene.coerce({"specular": 1, "ambient": 1, "lights": [{"type": "sh", "preset": "left"}]})
        ).any()

    @settings(max_examples=30, deadline=None)
    @given(st.floats(-180, 180), st.floats(-90, 90), st.floats(0.05, 1), st.sampled_from([0.0, 1.0, 1e6]))
    def test_any_light(self, azimuth, elevation, roughness, intensity):
        """Grazing, behind, a mirror, enormous: finite and not negative."""
        light = {"type": "directional", "azimuth": azimuth, "elevation": elevation, "intensity": intensity}
        shine = self.shine(Scene.coerce({"specular": 1, "roughness": roughness, "lights": [light]}))
        assert np.isfinite(shine).all()
        assert shine.min() >= 0
