"""A drawn face for the tests of makeup."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from graphface.nodes.makeup.features import features
from graphface.nodes.types import Correspondence, Features, Image, Landmarks, Mask, Mesh, Surface
from graphface.nodes.warp.mesh import mesh as correspond

SIZE = 200


@dataclass(frozen=True)
class Face:
    photo: Image
    landmarks: Landmarks
    mesh: Mesh
    surface: Surface
    features: Features

    @property
    def everywhere(self) -> Mask:
        return np.ones((SIZE, SIZE), np.float32)

    @property
    def nowhere(self) -> Mask:
        return np.zeros((SIZE, SIZE), np.float32)

    def disc(self, radius: float) -> NDArray[np.bool_]:
        """Pixels around the middle of a cheek; the radius in inter-ocular distances."""
        x, y = self.landmarks.points[50, :2]
        rows, columns = np.ogrid[:SIZE, :SIZE]
        return np.hypot(columns - x, rows - y) < radius * self.landmarks.interocular

    @property
    def onto_itself(self) -> Correspondence:
        return correspond(self.surface, self.mesh, self.surface, self.mesh)


@pytest.fixture
def face(make_face):
    """A frontal face in a picture of SIZE x SIZE pixels, whose lower left corner shows no face."""
    photo, landmarks, mesh, surface = make_face(size=SIZE, scale=0.45)
    return Face(photo, landmarks, mesh, surface, features(photo, landmarks))
