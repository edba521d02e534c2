"""The underside of the jaw, the neck and its foot, for a face mesh that ends at the jaw.

All in the mean face's frame (see `graphface.nodes.head_shape`): unit = distance between the outer eye corners, x to the
picture's right, y up, z to the viewer.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.normals import vertex_normals

Points = NDArray[np.float64]


Solid = tuple[Points, Points, NDArray[np.int32]]
"""Vertices (n, 3), unit normals (n, 3), triangles (m, 3) counter-clockwise seen from outside."""


SECTIONS = (
    # height, half breadth, z of the front, z of the back
    (-0.30, 0.60, -0.26, -1.66),
    (-0.95, 0.60, -0.30, -1.72),
    (-1.18, 0.69, -0.34, -1.81),
    (-1.28, 0.83, -0.38, -1.87),
    (-1.38, 1.01, -0.45, -1.92),
)
"""Ellipses. Their shape is that of the neck of ICT-FaceKit's mean head (MIT), measured level by level and rounded;
their place under the chin is that of the anthropometric neck in `graphface.nodes.head_shape`. They end where the neck
does: shoulders need not face as the head does, and a head's shadow on shoulders that are elsewhere is a blotch.

On path-traced heads 28.5 against 28.1 dB for a plain cylinder, 26.0 against 25.5 with light from above. (Going on with
shoulders of average breadth adds nothing.)"""


_DROP = 0.10
"""How far below its edge the underside of the jaw meets the neck."""


_ROUND = 0.12
"""Length over which the jaw's edge is rounded, as far as it leads on in the direction of the face."""


_SUNK = 0.03
"""How far the underside reaches into the neck, as a share of its radius: no gap for light to get through."""


_STEPS = 6


def neck(rows: int = 24, sectors: int = 64) -> Solid:
    """The ellipses of `SECTIONS`, joined."""
    heights = np.linspace(SECTIONS[0][0], SECTIONS[-1][0], rows + 1)
    turn = np.linspace(0, 2 * np.pi, sectors + 1)
    points = _on_section(heights[:, None], turn[None, :]).reshape(-1, 3)
    triangles = grid_triangles(rows, sectors)
    normals = vertex_normals(points, triangles).astype(np.float64)
    _close(normals.reshape(rows + 1, sectors + 1, 3))
    return points, normals, triangles


def underside(edge: Points, outward: Points) -> Solid:
    """The surface from the edge of the jaw to the neck; it leaves the face without a crease.

    Args:
        edge: (n, 3), n >= 2, along the rim of the face from the picture's left to its right.
        outward: (n, 3), the face's unit normals there.
    """
    along = np.gradient(edge, axis=0)
    onward = np.cross(along, outward)  # across the edge, away from the face
    onward /= np.maximum(np.linalg.norm(onward, axis=1, keepdims=True), 1e-9)
    height = np.clip(edge[:, 1] - _DROP, SECTIONS[-1][0], SECTIONS[0][0])
    breadth, depth, middle = _section(height)
    turn = np.arctan2(edge[:, 0] / breadth, (edge[:, 2] - middle) / depth)
    at_neck = _on_section(height, turn, 1 - _SUNK)
    rounded = edge + _ROUND * onward
    control = rounded + (at_neck - rounded) / 4
    t = np.linspace(0, 1, _STEPS + 1)[:, None, None]
    curve = (1 - t) ** 3 * edge + 3 * (1 - t) ** 2 * t * rounded + 3 * (1 - t) * t**2 * control + t**3 * at_neck
    points, triangles = curve.reshape(-1, 3), grid_triangles(_STEPS, len(edge) - 1)
    normals = vertex_normals(points, triangles).astype(np.float64)
    normals[: len(edge)] = outward
    return points, normals, triangles


def grid_triangles(rows: int, columns: int) -> NDArray[np.int32]:
    """Triangles of a grid of (rows + 1) x (columns + 1) points, counter-clockwise seen from outside."""
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).reshape(-1)
    right, below = first + 1, first + columns + 1
    corners = np.concatenate([np.stack([first, below, right], 1), np.stack([right, below, below + 1], 1)])
    return corners.astype(np.int32)


def _section(height: Points) -> tuple[Points, Points, Points]:
    """Half breadth, half depth, and z of the middle of the ellipses at some heights."""
    table = np.asarray(SECTIONS[::-1])
    breadth, front, back = (np.interp(height, table[:, 0], table[:, k]) for k in (1, 2, 3))
    return breadth, (front - back) / 2, (front + back) / 2


def _on_section(height: Points, turn: Points, share: float = 1.0) -> Points:
    """Points at angles about the neck, 0 in front and positive to the picture's right; `share` of the radius."""
    breadth, depth, middle = _section(height)
    x, z = share * breadth * np.sin(turn), middle + share * depth * np.cos(turn)
    return np.stack(np.broadcast_arrays(x, height, z), axis=-1)


def _close(normals: Points) -> None:
    """The first and the last column of a ring are the same points, and get the same normals."""
    seam = normals[:, 0] + normals[:, -1]
    normals[:, 0] = normals[:, -1] = seam / np.maximum(np.linalg.norm(seam, axis=1, keepdims=True), 1e-9)
