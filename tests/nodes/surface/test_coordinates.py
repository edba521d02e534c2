"""Which point of the face each pixel shows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from faces import fitted

from graphface import UsageError
from graphface.nodes.surface.coordinates import coordinates


class TestCoordinates:
    def test_are_the_same_point_on_any_face(self):
        """Where two different faces in different poses agree in coordinates, it is the same place of the model."""
        _, one, one_surface = fitted(0, 1)
        _, other, other_surface = fitted(25, 2)
        at = coordinates(one_surface, one)
        vertex = 4  # the nose tip
        x, y = np.rint(one.camera.project(one.vertices[vertex])).astype(int)
        there = coordinates(other_surface, other)
        nearest = np.linalg.norm(there - at[y, x], axis=2)
        found = np.unravel_index(nearest.argmin(), nearest.shape)[::-1]
        assert np.linalg.norm(found - other.camera.project(other.vertices[vertex])) < 2

    def test_off_the_face_there_are_none(self):
        """Minus one off the face, within [0, 1] on it."""
        _, mesh, surface = fitted()
        at = coordinates(surface, mesh)
        assert (at[surface.coverage == 0] == -1).all()
        assert 0 <= at[surface.coverage > 0].min() <= at[surface.coverage > 0].max() <= 1

    def test_a_mesh_without_them_is_an_error(self):
        """The user is told which geometry has them."""
        _, mesh, surface = fitted()
        with pytest.raises(UsageError, match=r"geometry\.morphable"):
            coordinates(surface, replace(mesh, uv=None))
