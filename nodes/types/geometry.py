"""A face in space: camera, landmarks, meshes, and the part of a mesh that the camera sees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types.agreement import mismatch, out_of_range, too_far
from graphface.nodes.types.arrays import Depth, FloatArray, Mask, Normals


@dataclass(frozen=True)
class Camera:
    """Camera frame to pixels: u = cx + scale * x / (1 - z * nearness), v = cy - scale * y / (1 - z * nearness).

    Attributes:
        scale: pixels per unit of the camera frame at z = 0.
        center: (cx, cy), in pixels.
        nearness: one over the distance of the camera, 0 or more. 0 is weak perspective, a camera infinitely far away.
    """

    scale: float = 1.0
    center: tuple[float, float] = (0.0, 0.0)
    nearness: float = 0.0

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        numbers = np.array([self.scale, *self.center, self.nearness], np.float64)
        if numbers.shape != (4,) or not np.isfinite(numbers).all() or self.scale <= 0 or self.nearness < 0:
            return f"a camera has a scale above 0, a centre and a nearness of 0 or more, this one is {self}"
        return None

    def project(self, vertices: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
        """Camera-frame points (..., 3) to pixel coordinates (..., 2)."""
        factor = self.scale / np.maximum(1 - vertices[..., 2] * self.nearness, 1e-3)
        x = self.center[0] + factor * vertices[..., 0]
        y = self.center[1] - factor * vertices[..., 1]
        return np.stack([x, y], axis=-1)


_POINTS = {"facemesh468": 468, "ibug68": 68}
"""Points of the schemes that operators know."""


@dataclass(frozen=True)
class Landmarks:
    """The points found on one face.

    Attributes:
        points: float32 (n, 3): x, y in pixels; z in pixels towards the viewer, 0 where the scheme has no depth.
        scheme: which points they are, "facemesh468" or "ibug68".
        score: the detector's confidence, 0..1.
        faces: number of faces in the photo.
    """

    points: FloatArray
    scheme: str
    score: float = 1.0
    faces: int = 1

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        count = _POINTS.get(self.scheme, "N")
        return mismatch(self, {"points": f"{count} 3"}) or too_far("points", self.points)

    @property
    def interocular(self) -> float:
        """Distance between the outer eye corners, in pixels: the unit of every face-relative length."""
        left, right = {"facemesh468": (33, 263), "ibug68": (36, 45)}[self.scheme]
        return float(np.linalg.norm(self.points[left] - self.points[right]))


@dataclass(frozen=True)
class FitRecord:
    """The result of fitting a face model, and how good it is.

    Attributes:
        model: name of the model.
        identity, expression: float32 (K,), coefficients in standard deviations.
        rotation: float64 (3, 3), face to camera frame.
        scale: pixels per outer-eye-corner distance of the mean face.
        distance: of the camera in that distance; 0 for weak perspective.
        residual: robustly weighted root mean square of the errors, pixels.
        errors: float32 (n,), pixels from each landmark to its vertex; 0 where there is no landmark.
        costs: float32, before the first and after each accepted step.
        condition: number of the last step's equations.
        converged: whether the cost stopped falling before the last iteration.
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

    Attributes:
        vertices: float32 (V, 3).
        triangles: int32 (T, 3), counter-clockwise seen from outside.
        normals: float32 (V, 3), unit length.
        camera: takes vertices to pixels.
        interocular: distance between the outer eye corners, pixels.
        uv: float32 (V, 2) in [0, 1], v up: position of each vertex in the model's texture, or None.
        mirror: int32, the vertex at the mirror image of each, or None. The vertices that `render.head` adds have none.
        facemesh: int32 (468,), the vertex at each of FaceMesh's points, -1 where there is none; or None.
        fit: of a fitted model, else None.
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

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        if not np.isfinite(self.interocular) or self.interocular < 0:
            return f"interocular is {self.interocular}, expected a length"
        count = len(self.vertices)
        shapes = {
            "vertices": "V 3",
            "normals": "V 3",
            "triangles": "T 3",
            "uv": "V 2",
            "mirror": "M",
            "facemesh": "468",
        }
        return (
            mismatch(self, shapes)
            or too_far("vertices", self.vertices)
            or out_of_range("triangles", self.triangles, count)
            or out_of_range("mirror", self.mirror, count, none=True)
            or out_of_range("facemesh", self.facemesh, count, none=True)
            or (
                "mirror is longer than there are vertices"
                if self.mirror is not None and len(self.mirror) > count
                else None
            )
        )


@dataclass(frozen=True)
class Surface:
    """A mesh rasterized into the picture.

    Attributes:
        normals: float32 H x W x 3, unit length; 0 where there is no surface.
        depth: float32 H x W, z in the camera frame, pixels; 0 where there is no surface.
        coverage: float32 H x W, 1 where there is a surface, else 0.
        triangle: int32 H x W, index of the visible triangle, -1 where there is none.
        barycentric: float32 H x W x 3, coordinates in it, summing to 1; 0 where there is none.
    """

    normals: Normals
    depth: Depth
    coverage: Mask
    triangle: NDArray[np.int32]
    barycentric: FloatArray

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        shapes = {"coverage": "H W", "depth": "H W", "triangle": "H W", "normals": "H W 3", "barycentric": "H W 3"}
        return (
            mismatch(self, shapes)
            or too_far("depth", self.depth)
            or out_of_range("triangle", self.triangle, 1 << 31, none=True)
        )


@dataclass(frozen=True)
class RefinedSurface:
    """What a picture says about the surface in it.

    Attributes:
        surface: with the normals that the picture shows.
        shadow: float32 H x W, 0..1, where something stands before the photo's strongest lamp.
    """

    surface: Surface
    shadow: Mask

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        return mismatch(self, {"surface.coverage": "H W", "shadow": "H W"})
