"""A surface with a step of light on it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from shapes import eyes_apart, surface_with

from graphface.nodes.types import FloatArray, Image, Landmarks, Scene, Surface

HEIGHT, WIDTH, UNIT = 60, 80, 40.0


@dataclass(frozen=True)
class Case:
    """Light of 0.5 everywhere, and a new light with a step in the middle, on a surface that ends before the border."""

    surface: Surface
    step: FloatArray
    old: FloatArray
    photo: Image
    landmarks: Landmarks

    def scattered(self, method, shading, radius=0.05, surface=None, photo=None):
        """The method's result, always with channels."""
        scene = Scene(scatter=radius)
        found = method(shading, self.old, surface or self.surface, self.landmarks, photo or self.photo, scene)
        return found.reshape(*found.shape[:2], -1)

    def with_depth(self, depth):
        """The surface at another depth."""
        return replace(self.surface, depth=depth)


@pytest.fixture
def case():
    normals = np.zeros((HEIGHT, WIDTH, 3), np.float32)
    normals[:, :-10, 2] = 1
    surface = surface_with(normals, np.ones((HEIGHT, WIDTH), np.float32))
    step = np.full((HEIGHT, WIDTH), 0.2, np.float32)
    step[:, : WIDTH // 2] = 0.8
    photo = Image(np.zeros((HEIGHT, WIDTH, 3), np.float32), encoding="linear")
    return Case(surface, step * surface.coverage, 0.5 * surface.coverage, photo, eyes_apart(UNIT))
