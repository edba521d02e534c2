"""Faces of the built-in model, and small models, that the tests of geometry share."""

from __future__ import annotations

import numpy as np

from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.model import Basis, MorphableModel
from graphface.nodes.morphable.pose import rotated
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Image, Landmarks, Mesh, Surface


def rotation_of(yaw=0.0, pitch=0.0, roll=0.0):
    """The rotation of a face that looks `yaw` degrees to the right and `pitch` up, rolled about its own axis."""
    rotation = rotated(np.eye(3), np.array([0, 0, np.radians(roll)]))
    rotation = rotated(rotation, np.array([-np.radians(pitch), 0, 0]))
    return rotated(rotation, np.array([0, np.radians(yaw), 0]))


def landmarks_of(
    model=None, coefficients=(), rotation=None, scale=150.0, center=(320.0, 240.0), near=0.0, scheme="facemesh468"
):
    """Exact landmarks of a known face under a known camera."""
    model = model or builtin_model()
    rotation = np.eye(3) if rotation is None else rotation
    shape = model.vertices(np.asarray(coefficients, float)) if len(coefficients) else model.mean.astype(float)
    placed = scale * shape @ rotation.T
    flat = placed[:, :2] / (1 - placed[:, 2:] * near / scale)
    vertices = model.landmarks[scheme]
    points = np.zeros((len(vertices), 3), np.float32)
    points[:, :2] = flat[np.maximum(vertices, 0)] * (1, -1) + center
    points[vertices < 0] = np.nan
    return Landmarks(points, scheme)


def coefficients_of(seed, spread=0.7, model=None):
    model = model or builtin_model()
    return np.random.default_rng(seed).normal(scale=spread, size=len(model.identity) + len(model.expression))


def grid_model(side=12, **changes):
    """A bulging square with 68 landmarks: the smallest thing of the right form."""
    y, x = np.mgrid[1 : -1 : side * 1j, -1 : 1 : side * 1j]
    mean = np.stack([x, y, 0.5 - 0.4 * (x**2 + y**2)], axis=-1).reshape(-1, 3).astype(np.float32)
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    a, b, c, d = corner, corner + side, corner + side + 1, corner + 1
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).astype(np.int32)
    rng = np.random.default_rng(3)
    directions = rng.normal(scale=0.02, size=(3, len(mean), 3)).astype(np.float32)
    parts = {
        "name": "grid",
        "mean": mean,
        "triangles": triangles,
        "identity": Basis(directions[:2], np.ones(2, np.float32), ("a", "b")),
        "expression": Basis(directions[2:], np.ones(1, np.float32), ("c",)),
        "landmarks": {"ibug68": np.linspace(0, len(mean) - 1, 68).astype(np.int32)},
    }
    return MorphableModel(**{**parts, **changes})


def fitted(
    yaw: float = 0.0, seed: int = 1, center: tuple[float, float] = (200.0, 150.0), near: float = 0.0
) -> tuple[Image, Mesh, Surface]:
    """A photo of 300 x 400 pixels, the fitted mesh and its surface, of a face about 150 pixels wide."""
    y, x = np.mgrid[:300, :400].astype(np.float32)
    pixels = np.stack([x / 400, y / 300, 0.5 + 0.4 * np.sin(x / 25) * np.sin(y / 25)], axis=2)
    photo = Image(pixels.astype(np.float32))
    face = landmarks_of(
        coefficients=coefficients_of(seed, 0.5), rotation=rotation_of(yaw), scale=80, center=center, near=near
    )
    mesh = morphable(face, camera="assumed" if near else "weak")
    return photo, mesh, rasterize(mesh, photo)
