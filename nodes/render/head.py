"""Light beyond the face mesh: the rest of the head and the neck as simple solids, so that they can be lit like it.

The face models end at the hairline, the jaw and the ears; a shading that merely continues there knows no neck in the
chin's shadow, no foot of the neck that catches the light from above, no side of the head that turns away. Solids of
average size do, roughly.
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
from graphface.nodes.render.neck import Points, Solid, grid_triangles, neck, underside
from graphface.nodes.types import Mesh

_LEAST_POINTS = 100
"""Points of FaceMesh that must be known on a mesh to say how the head stands."""


_BEHIND = 0.2
"""How far the skull stays behind the middle of the face, as a share of its size, so that it does not poke through."""


_TEMPLE, _FREE = 0.25, 0.35
"""Height of the temples in the mean face's frame; how far the skull stays behind the jaw, as a share of its size."""


_NEAR, _REACH = 0.12, 0.4
"""Angles, seen from the middle of the skull, over which the skull follows the face's rim, and after which it no longer
does."""


_JAW = 0.05
"""Height in the mean face's frame below which the rim of the mesh is the edge of the jaw."""


_STRANGE = 0.2
"""Root mean square distance from the posed mean face, in its unit, above which points are not FaceMesh's."""


@node("render.head")
def head(mesh: Mesh, *, solids: bool = True) -> Mesh:
    """A face mesh with a cranium and a neck of average size behind it, in the face's own pose.

    Args:
        mesh: of `geometry.*`. Where its pose is not known (`Mesh.facemesh` tells of few points, or of wrong ones) it
            comes back as it is.
        solids: False leaves the mesh as it is, to see what they are good for.

    Returns:
        The same mesh with vertices and triangles added at the end; camera, unit and fit are the face's.
    """
    if not solids:
        return mesh
    face = _face_points(mesh)
    known = np.asarray(np.isfinite(face).all(axis=1))
    pose = _pose(face[known], known)
    if pose is None:
        warn("render.head: the mesh tells no pose of the face; light beyond it is continued without a head")
        return mesh
    rotation, scale, middle = pose
    own = np.where(known[:, None], (face - middle) @ rotation / scale, facemesh_topology().mean)
    jaw = _jaw()
    parts = [_skull(own), neck(), underside(own[jaw], _outward(own)[jaw])]
    vertices, normals, triangles = [mesh.vertices], [mesh.normals], [mesh.triangles]
    count = len(mesh.vertices)
    for points, outward, faces in parts:
        vertices.append((middle + scale * points @ rotation.T).astype(np.float32))
        normals.append((outward @ rotation.T).astype(np.float32))
        triangles.append((faces + count).astype(np.int32))
        count += len(points)
    return replace(
        mesh,
        vertices=np.concatenate(vertices),
        triangles=np.concatenate(triangles),
        normals=np.concatenate(normals),
        uv=None if mesh.uv is None else np.concatenate([mesh.uv, np.zeros((count - len(mesh.uv), 2), np.float32)]),
    )


def _face_points(mesh: Mesh) -> Points:
    """Where the 468 points of FaceMesh lie, NaN where the mesh does not know them."""
    face = np.full(facemesh_topology().mean.shape, np.nan)
    if mesh.facemesh is not None and len(mesh.facemesh) == len(face):
        known = (mesh.facemesh >= 0) & (mesh.facemesh < len(mesh.vertices))
        face[known] = mesh.vertices[mesh.facemesh[known]]
    return face


def _pose(points: Points, known: NDArray[np.bool_]) -> tuple[Points, float, Points] | None:
    """Rotation, scale and origin of the mean face in the camera frame, by its known points (Umeyama 1991)."""
    if len(points) < _LEAST_POINTS:
        return None
    mean = facemesh_topology().mean[known].astype(np.float64)
    from_middle, to_middle = mean.mean(axis=0), points.mean(axis=0)
    u, sizes, vt = np.linalg.svd((points - to_middle).T @ (mean - from_middle))
    sign = np.array([1, 1, np.sign(np.linalg.det(u @ vt)) or 1.0])
    rotation = (u * sign) @ vt
    scale = float((sizes * sign).sum() / max(np.square(mean - from_middle).sum(), 1e-12))
    if scale <= 1e-6:
        return None
    apart = (points - to_middle) / scale - (mean - from_middle) @ rotation.T
    strange = float(np.sqrt(np.square(apart).sum(axis=1).mean())) > _STRANGE
    return None if strange else (rotation, scale, to_middle - scale * rotation @ from_middle)


def _outward(face: Points) -> Points:
    """Unit normals of a face given by FaceMesh's points, (468, 3)."""
    return vertex_normals(face, facemesh_topology().triangles).astype(np.float64)


def _skull(face: Points) -> Solid:
    """The ellipsoid, drawn to the rim of this face, so that no step between the two throws a shadow.

    Args:
        face: (468, 3) in the mean face's frame.
    """
    center, axes = (np.asarray(v) for v in CRANIUM)
    points, normals, triangles = _ellipsoid(CRANIUM[0], CRANIUM[1])
    unit, seen = (points - center) / axes, (face - center) / axes
    size = np.linalg.norm(seen, axis=1)
    rim = _rim()
    inside = np.linalg.norm(face[:, None] - face[None, rim], axis=2).min(axis=1)
    below = np.clip((_TEMPLE - face[:, 1]) / _TEMPLE, 0, 1)  # the jaw stands free of skull and neck, and shades them
    goal = size - np.maximum(np.minimum(inside / 2, _BEHIND), _FREE * below)
    cosine = np.clip(unit @ (seen / np.maximum(size, 1e-6)[:, None]).T, -1, 1)
    weight = np.exp(-np.square(np.arccos(cosine) / _NEAR) / 2)
    rest = np.exp(-((_REACH / _NEAR) ** 2) / 2)
    scale = 1 + weight @ (goal - 1) / (weight.sum(axis=1) + rest)
    return center + np.clip(scale, 0.5, 1.5)[:, None] * unit * axes, normals, triangles


@cache
def _rim() -> NDArray[np.int64]:
    """The points along the outline of the face mesh, once around; with the face to their left, seen from outside."""
    triangles = facemesh_topology().triangles
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).tolist()
    inner = {(b, a) for a, b in sides}
    onward = {a: b for a, b in sides if (a, b) not in inner}
    rim = [FOREHEAD]
    while onward[rim[-1]] != FOREHEAD:
        rim.append(onward[rim[-1]])
    return np.array(rim)


@cache
def _jaw() -> NDArray[np.int64]:
    """The part of the rim below the ears, from the picture's left to its right."""
    rim = _rim()  # from the middle of the forehead down one side and up the other: the jaw is one run of it
    mean = facemesh_topology().mean
    jaw: NDArray[np.int64] = rim[mean[rim, 1] < _JAW]
    return jaw if mean[jaw[0], 0] < 0 else jaw[::-1]


def _ellipsoid(center: tuple[float, ...], axes: tuple[float, ...], rings: int = 24, sectors: int = 48) -> Solid:
    """Vertices, outward normals and triangles."""
    down, around = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, sectors + 1), indexing="ij")
    unit = np.stack([np.sin(down) * np.sin(around), np.cos(down), np.sin(down) * np.cos(around)], axis=-1)
    points = (np.asarray(center) + unit * axes).reshape(-1, 3)
    normals = (unit / axes).reshape(-1, 3)
    return points, normals / np.linalg.norm(normals, axis=1, keepdims=True), grid_triangles(rings, sectors)
