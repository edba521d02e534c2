"""The underside of the jaw, the neck and its foot, for a face mesh that ends at the jaw.

All in the mean face's frame (see `graphface.nodes.head_shape`): unit = distance between the outer eye corners, x to the
picture's right, y up, z towards the viewer.
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
"""Ellipses from top to bottom. Their shape is that of the neck of ICT-FaceKit's mean head (MIT license), measured at
each height and rounded; their position under the chin is that of the anthropometric neck in
`graphface.nodes.head_shape`. They end where the neck does, because shoulders may face another direction than the head,
and a shadow on shoulders that are elsewhere is a blotch.

On path-traced heads 28.5 dB, a plain cylinder 28.1 dB; with light from above 26.0 and 25.5 dB. Shoulders of average
breadth add nothing."""


_JOIN_DEPTH = 0.10
"""How far below the edge of the jaw its underside meets the neck."""


_ROUNDING = 0.12
"""Length over which the edge of the jaw is rounded; the surface first continues in the direction of the face."""


_OVERLAP = 0.03
"""How far the underside reaches into the neck, as a share of the neck's radius, so that no light passes between."""


_UNDERSIDE_STEPS = 6


def neck(rows: int = 24, sectors: int = 64) -> Solid:
    """The surface through the ellipses of `SECTIONS`."""
    heights = np.linspace(SECTIONS[0][0], SECTIONS[-1][0], rows + 1)
    angles = np.linspace(0, 2 * np.pi, sectors + 1)
    points = _on_section(heights[:, None], angles[None, :]).reshape(-1, 3)
    triangles = grid_triangles(rows, sectors)
    normals = vertex_normals(points, triangles).astype(np.float64)
    _close_seam(normals.reshape(rows + 1, sectors + 1, 3))
    return points, normals, triangles


def underside(edge: Points, outward: Points) -> Solid:
    """The surface from the edge of the jaw to the neck: cubic Bézier curves that leave the face without a crease.

    Args:
        edge: (n, 3), n >= 2, along the outline of the face from the picture's left to its right.
        outward: (n, 3), the face's unit normals there.
    """
    along = np.gradient(edge, axis=0)
    onward = np.cross(along, outward)  # across the edge, away from the face
    onward /= np.maximum(np.linalg.norm(onward, axis=1, keepdims=True), 1e-9)
    height = np.clip(edge[:, 1] - _JOIN_DEPTH, SECTIONS[-1][0], SECTIONS[0][0])
    breadth, depth, middle = _section(height)
    angle = np.arctan2(edge[:, 0] / breadth, (edge[:, 2] - middle) / depth)
    at_neck = _on_section(height, angle, 1 - _OVERLAP)
    first_control = edge + _ROUNDING * onward
    second_control = first_control + (at_neck - first_control) / 4
    t = np.linspace(0, 1, _UNDERSIDE_STEPS + 1)[:, None, None]
    bend = 3 * (1 - t) ** 2 * t * first_control
    curve = (1 - t) ** 3 * edge + bend + 3 * (1 - t) * t**2 * second_control + t**3 * at_neck
    points, triangles = curve.reshape(-1, 3), grid_triangles(_UNDERSIDE_STEPS, len(edge) - 1)
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


def _on_section(height: Points, angle: Points, radius: float = 1.0) -> Points:
    """Points on the ellipses at angles about the neck, 0 in front and positive to the picture's right.

    Args:
        radius: as a share of the ellipse's.
    """
    breadth, depth, middle = _section(height)
    x, z = radius * breadth * np.sin(angle), middle + radius * depth * np.cos(angle)
    return np.stack(np.broadcast_arrays(x, height, z), axis=-1)


def _close_seam(normals: Points) -> None:
    """Give the first and the last point of each ring, which coincide, the same normal."""
    seam = normals[:, 0] + normals[:, -1]
    normals[:, 0] = normals[:, -1] = seam / np.maximum(np.linalg.norm(seam, axis=1, keepdims=True), 1e-9)
