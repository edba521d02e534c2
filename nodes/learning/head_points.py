"""Where the FaceMesh network puts its 468 points on a head model.

The truth heads were made from the model, so the surface under every pixel is known. The points that the network finds
on their pictures are looked up on it, and the median over heads and lights is made symmetric.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import GraphfaceError, warn
from graphface.nodes.bench.heads import LIGHTS, Head, heads_of
from graphface.nodes.landmarks.facemesh import facemesh
from graphface.nodes.morphable.normals import vertex_normals
from graphface.nodes.morphable.readers.ict import IctHead
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.rasterize import rasterized
from graphface.nodes.types import Camera, Mesh, Surface

Array = NDArray[np.float64]


Vertices = Callable[[NDArray[Any]], Array]


_LEAST_FACING = 0.25
"""Least n_z of the surface under a point. At the outline a point slides over the skin."""


_BARYCENTRIC_STEPS = 8
"""A point on the surface is looked for among so many steps along each side of every triangle."""


@dataclass(frozen=True)
class OnSurface:
    """Points on a mesh: the `triangle` (n,) of each, and `weights` (n, 3) of its corners."""

    triangle: NDArray[np.int64]
    weights: Array

    def at(self, values: NDArray[Any], triangles: NDArray[np.int64]) -> Array:
        """Values (..., V, 3) of vertices, interpolated: (..., n, 3)."""
        corners = values[..., triangles[self.triangle], :]
        found: Array = np.einsum("nk,...nkc->...nc", self.weights, corners)
        return found


def facemesh_on_head(head: IctHead, of: Vertices, triangles: NDArray[np.int64], data: Path) -> OnSurface:
    """The 468 points on the mean head.

    Args:
        of: takes values at the head's vertices to those of the surface; `triangles` are numbered among these.
        data: the folder that holds `truth`.

    Raises:
        UnreadableFile: there are no heads at `data`.
    """
    mean = of(head.mean)
    seen = np.stack([points for truth in heads_of(data) for points in _seen(truth, head, of, triangles)])
    count = np.isfinite(seen[..., 0]).sum(axis=0)[:, None].astype(np.float64)
    seen[:, count[:, 0] == 0] = 0
    points = np.nanmedian(seen, axis=0)
    mirror = facemesh_topology().mirror
    total = points * count + points[mirror] * (-1, 1, 1) * count[mirror]
    return nearest_on(total / np.maximum(count + count[mirror], 1), mean, triangles)


def nearest_on(points: Array, vertices: Array, triangles: NDArray[np.int64]) -> OnSurface:
    """The nearest points of a surface, among regularly spaced ones on each of its triangles."""
    from scipy.spatial import cKDTree

    steps = range(_BARYCENTRIC_STEPS)
    shares = np.array([(i, j, _BARYCENTRIC_STEPS - 1 - i - j) for i in steps for j in steps if i + j in steps])
    weights = shares / (_BARYCENTRIC_STEPS - 1)
    spread = np.einsum("bk,tkc->tbc", weights, vertices[triangles]).reshape(-1, 3)
    nearest = cKDTree(spread).query(points)[1]
    return OnSurface(nearest // len(weights), weights[nearest % len(weights)])


def _seen(truth: Head, head: IctHead, of: Vertices, triangles: NDArray[np.int64]) -> list[Array]:
    """The points found in each picture of a head, on the mean head (468, 3); NaN where a point is not well seen."""
    surface = _surface(truth, head, of, triangles)
    mean = of(head.mean)
    height, width = surface.triangle.shape
    found = []
    for light in LIGHTS:
        try:
            landmarks = facemesh(truth.photo(light))
        except GraphfaceError as error:
            warn(f"{truth.name}/{light} is left out: {error}")
            continue
        column, row = np.rint(landmarks.points[:, :2]).astype(int).T
        at = row.clip(0, height - 1), column.clip(0, width - 1)
        points = OnSurface(surface.triangle[at].astype(np.int64), surface.barycentric[at]).at(mean, triangles)
        points[(surface.triangle[at] < 0) | (surface.normals[at][:, 2] < _LEAST_FACING)] = np.nan
        found.append(points)
    return found


def _surface(truth: Head, head: IctHead, of: Vertices, triangles: NDArray[np.int64]) -> Surface:
    """The model as the camera of a truth head sees it, by the head's coefficients and its 68 points."""
    import cv2

    meta = json.loads((truth.folder / "meta.json").read_text(encoding="utf-8"))
    shape = head.mean + np.tensordot(np.asarray(meta["identity"]), head.identity[: len(meta["identity"])], 1)
    for name, weight in meta["expression"].items():
        shape = shape + weight * head.expression[head.names.index(name)]
    height, width = truth.face.shape
    focal = height / 2 / np.tan(np.radians(meta["camera"]["fov_deg"]) / 2)
    optics = np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1]])
    in_opencv = shape.astype(np.float64) * (1, -1, -1)
    _, rotation, translation = cv2.solvePnP(in_opencv[head.landmarks], np.asarray(meta["landmarks68"]), optics, None)
    placed = (of(in_opencv) @ cv2.Rodrigues(rotation)[0].T + translation.ravel()) * (1, -1, -1)
    distance = -float(placed[:, 2].mean())
    placed[:, 2] += distance
    corners = triangles.astype(np.int32)
    camera = Camera(scale=focal / distance, center=(width / 2, height / 2), nearness=1 / distance)
    normals = vertex_normals(placed, corners)
    mesh = Mesh(placed.astype(np.float32), corners, normals, camera, interocular=focal / distance)
    return rasterized(mesh, (height, width), smoothing=0)
