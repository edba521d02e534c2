"""The rest of the head and the neck as simple solids behind the face mesh, so that they are shaded like the face.

The face models end at the hairline, the jaw and the ears. A shading that only continues beyond them has no shadow of
the chin on the neck, no base of the neck that light from above reaches, and no side of the head that turns away from
the light. Solids of average size have them approximately.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from graphface import node, warn
from graphface.nodes.head_shape import CRANIUM
from graphface.nodes.morphable.normals import vertex_normals
from graphface.nodes.morphable.topology import FOREHEAD, facemesh_topology
from graphface.nodes.render.head_pose import face_points, head_pose
from graphface.nodes.render.neck import Points, Solid, grid_triangles, neck, underside
from graphface.nodes.types import Mesh

_FACE_GAP, _JAW_GAP = 0.2, 0.35
"""Gap between the cranium and the middle of the face, and between the cranium and the jaw, as shares of the cranium's
radius. Because of the gaps the cranium does not protrude through the face, and the jaw casts a shadow on the neck."""


_TEMPLE_HEIGHT, _JAW_HEIGHT = 0.25, 0.05
"""Heights in the mean face's frame: of the temples, and below which the outline of the mesh is the edge of the jaw."""


_KERNEL_WIDTH, _KERNEL_REACH = 0.12, 0.4
"""Radians at the middle of the cranium: standard deviation of the kernel by which the cranium follows the face's
outline, and the angle beyond which it keeps its own shape."""


@node("render.head")
def head(mesh: Mesh, *, solids: bool = True) -> Mesh:
    """A face mesh with a cranium and a neck of average size behind it, in the face's own pose.

    Args:
        mesh: of `geometry.*`. If too few of its FaceMesh points are known to estimate the pose, or they do not look
            like a face, it is returned as it is, with a warning.
        solids: False returns the mesh as it is, for comparison.

    Returns:
        The same mesh with vertices and triangles added at the end; camera, unit and fit are the face's.
    """
    if not solids:
        return mesh
    face = face_points(mesh)
    known = np.asarray(np.isfinite(face).all(axis=1))
    pose = head_pose(face[known], facemesh_topology().mean[known])
    if pose is None:
        warn("render.head: the pose of the head cannot be estimated from this mesh; no head is added to it")
        return mesh
    rotation, scale, origin = pose
    in_mean_frame = np.where(known[:, None], (face - origin) @ rotation / scale, facemesh_topology().mean)
    jaw = _jaw()
    parts = [_cranium(in_mean_frame), neck(), underside(in_mean_frame[jaw], _normals(in_mean_frame)[jaw])]
    vertices, normals, triangles = [mesh.vertices], [mesh.normals], [mesh.triangles]
    count = len(mesh.vertices)
    for points, directions, corners in parts:
        vertices.append((origin + scale * points @ rotation.T).astype(np.float32))
        normals.append((directions @ rotation.T).astype(np.float32))
        triangles.append((corners + count).astype(np.int32))
        count += len(points)
    return replace(
        mesh,
        vertices=np.concatenate(vertices),
        triangles=np.concatenate(triangles),
        normals=np.concatenate(normals),
        uv=None if mesh.uv is None else np.concatenate([mesh.uv, np.zeros((count - len(mesh.uv), 2), np.float32)]),
    )


def _normals(face: Points) -> Points:
    """Unit normals of a face given by the points of FaceMesh, (468, 3)."""
    return vertex_normals(face, facemesh_topology().triangles).astype(np.float64)


def _cranium(face: Points) -> Solid:
    """The ellipsoid of an average cranium, deformed to meet the outline of the face, so that no step casts a shadow.

    Its radius is a kernel regression of the radii that fit the face, by the angle seen from the middle.

    Args:
        face: (468, 3) in the mean face's frame.
    """
    center, axes = (np.asarray(v) for v in CRANIUM)
    points, normals, triangles = _ellipsoid(CRANIUM[0], CRANIUM[1])
    directions, to_face = (points - center) / axes, (face - center) / axes
    radius = np.linalg.norm(to_face, axis=1)
    from_outline = np.linalg.norm(face[:, None] - face[None, _outline()], axis=2).min(axis=1)
    below_temples = np.clip((_TEMPLE_HEIGHT - face[:, 1]) / _TEMPLE_HEIGHT, 0, 1)
    wanted = radius - np.maximum(np.minimum(from_outline / 2, _FACE_GAP), _JAW_GAP * below_temples)
    cosine = np.clip(directions @ (to_face / np.maximum(radius, 1e-6)[:, None]).T, -1, 1)
    weight = np.exp(-np.square(np.arccos(cosine) / _KERNEL_WIDTH) / 2)
    own_weight = np.exp(-((_KERNEL_REACH / _KERNEL_WIDTH) ** 2) / 2)
    scale = 1 + weight @ (wanted - 1) / (weight.sum(axis=1) + own_weight)
    return center + np.clip(scale, 0.5, 1.5)[:, None] * directions * axes, normals, triangles


@cache
def _outline() -> NDArray[np.int64]:
    """The points along the outline of the face mesh, once around; with the face to their left, seen from outside."""
    triangles = facemesh_topology().triangles
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).tolist()
    reversed_sides = {(b, a) for a, b in sides}
    following = {a: b for a, b in sides if (a, b) not in reversed_sides}
    outline = [FOREHEAD]
    while following[outline[-1]] != FOREHEAD:
        outline.append(following[outline[-1]])
    return np.array(outline)


@cache
def _jaw() -> NDArray[np.int64]:
    """The part of the outline below the ears, from the picture's left to its right."""
    outline = _outline()  # it starts at the middle of the forehead, so the jaw is one run of it
    mean = facemesh_topology().mean
    jaw: NDArray[np.int64] = outline[mean[outline, 1] < _JAW_HEIGHT]
    return jaw if mean[jaw[0], 0] < 0 else jaw[::-1]


def _ellipsoid(center: tuple[float, ...], axes: tuple[float, ...], rings: int = 24, sectors: int = 48) -> Solid:
    """Vertices, outward unit normals and triangles of an ellipsoid."""
    polar, azimuth = np.meshgrid(
        np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, sectors + 1), indexing="ij"
    )
    unit = np.stack([np.sin(polar) * np.sin(azimuth), np.cos(polar), np.sin(polar) * np.cos(azimuth)], axis=-1)
    points = (np.asarray(center) + unit * axes).reshape(-1, 3)
    normals = (unit / axes).reshape(-1, 3)
    return points, normals / np.linalg.norm(normals, axis=1, keepdims=True), grid_triangles(rings, sectors)
