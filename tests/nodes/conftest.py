"""What the tests of face operators share."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import FloatArray, Image, Landmarks, Mesh, Surface


@pytest.fixture
def rng() -> np.random.Generator:
    """A random generator that is the same in every run."""
    return np.random.default_rng(7)


Face = tuple[Image, Landmarks, Mesh, Surface]


def texture(points: FloatArray, size: int, frequency: float = 7.0) -> FloatArray:
    """A smooth pattern of the picture's own coordinates, H x W x 3 in 0.2..0.8."""
    y, x = np.mgrid[:size, :size].astype(np.float32) / size
    waves = [np.sin(frequency * (x * a + y * b)) for a, b in ((3, 1), (1, 3), (2, -2))]
    return (0.5 + 0.3 * np.stack(waves, axis=2)).astype(np.float32)


@pytest.fixture
def make_face() -> Callable[..., Face]:
    """A face in a square picture: its size, how far it is turned (degrees), how it is scaled and moved."""

    def make(size: int = 160, yaw: float = 0.0, scale: float = 0.4, shift: tuple[float, float] = (0, 0)) -> Face:
        angle = np.radians(yaw)
        turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
        shape = facemesh_topology().mean @ turn.T * (scale * size)
        points = shape * (1, -1, 1) + (size / 2 + shift[0], size / 2 + shift[1], 0)
        landmarks = Landmarks(points.astype(np.float32), "facemesh468")
        photo = Image(texture(points, size))
        mesh = facemesh(landmarks)
        return photo, landmarks, mesh, rasterize(mesh, photo)

    return make
