"""A face in space: camera, landmarks, meshes, and the part of a mesh that the camera sees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types.arrays import Depth, FloatArray, Mask, Normals


@dataclass(frozen=True)
class Camera:
    """Camera frame to pixels: u = cx + scale * x / (1 - z * nearness), v = cy - scale * y / (1 - z * nearness).

    `nearness` is one over the camera's distance: 0 is the weak perspective (a camera infinitely far away), and full
    perspective is continuous with it.
    """

    scale: float = 1.0
    center: tuple[float, float] = (0.0, 0.0)
    nearness: float = 0.0

    def project(self, vertices: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
        """Camera-frame points (..., 3) to pixel coordinates (..., 2)."""
        factor = self.scale / np.maximum(1 - vertices[..., 2] * self.nearness, 1e-3)
        x = self.center[0] + factor * vertices[..., 0]
        y = self.center[1] - factor * vertices[..., 1]
        return np.stack([x, y], axis=-1)


@dataclass(frozen=True)
class Landmarks:
    """The points found on one face.

    `points` float32 (n, 3): x, y in pixels, z in pixels towards the viewer (0 where the scheme has no depth).
    `scheme` names the points: "facemesh468" or "ibug68". `score` is the detector's confidence, 0..1. `faces` is how
    many faces the photo has.
    """

    points: FloatArray
    scheme: str
    score: float = 1.0
    faces: int = 1

    @property
    def interocular(self) -> float:
        """Distance between the outer eye corners, in pixels: the unit of every face-relative length."""
        left, right = {"facemesh468": (33, 263), "ibug68": (36, 45)}[self.scheme]
        return float(np.linalg.norm(self.points[left] - self.points[right]))


@dataclass(frozen=True)
class FitRecord:
    """How a face model was fitted: what it found, and how well.

    `identity` and `expression` float32 (K,) in standard deviations; `rotation` float64 (3, 3), face to camera frame;
    `scale` pixels for one outer-eye-corner distance of the mean face; `distance` of the camera in that unit, 0 for the
    weak perspective. `errors` float32 (n,) pixels from each landmark to its vertex, NaN-free: 0 where there is no
    landmark; `residual` their root mean square, robustly weighted; `costs` after each accepted step; `condition` of the
    last step's equations; `converged` where the cost came to rest.
    """

    model: str
    identity: FloatArray
    expression: FloatArray
    rotation: NDArray[np.float64]
    scale: float
    distance: float
    residual: float
    errors: FloatArray
    costs: FloatArray
    condition: float
    converged: bool


@dataclass(frozen=True)
class Mesh:
    """A triangulated face in the camera frame.

    `vertices` float32 (V, 3); `triangles` int32 (T, 3), counter-clockwise seen from outside; `normals` float32 (V, 3)
    unit; `camera` takes vertices to pixels; `interocular` in pixels. `uv` float32 (V, 2) in [0, 1], v up: where the
    model's texture has each vertex. `mirror` int32 (V,): the vertex that each becomes in a mirror, where that is known.
    `facemesh` int32 (468,): the vertex at each of FaceMesh's points, -1 where there is none. `fit` where a model was
    fitted.
    """

    vertices: FloatArray
    triangles: NDArray[np.int32]
    normals: FloatArray
    camera: Camera
    interocular: float
    uv: FloatArray | None = None
    mirror: NDArray[np.int32] | None = None
    facemesh: NDArray[np.int32] | None = None
    fit: FitRecord | None = None


@dataclass(frozen=True)
class Surface:
    """A mesh drawn into the picture's pixels.

    `triangle` int32 H x W: index of the visible triangle, -1 where there is none; `barycentric` float32 H x W x 3.
    """

    normals: Normals
    depth: Depth
    coverage: Mask
    triangle: NDArray[np.int32]
    barycentric: FloatArray
