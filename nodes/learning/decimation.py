"""Fewer triangles for a mesh whose vertices keep their places, so that a basis of directions stays valid.

Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997, with half-edge collapses: an
edge collapses into one of its two ends. The remaining vertices are a subset of the old ones.
"""

from __future__ import annotations

import heapq

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


_LEAST_COSINE = 0.3
"""Of the angle by which a triangle may turn in one collapse."""


_LENGTH_WEIGHT = 1e-3
"""Weight of the squared edge length, so that flat areas keep triangles of one size."""


def decimated(points: Array, triangles: NDArray[np.int64], importance: Array, count: int) -> NDArray[np.int64]:
    """About `count` triangles (T, 3) between some of the vertices, numbered as before.

    Args:
        points: (V, 3). triangles: (T, 3), a manifold; vertices on its boundary stay.
        importance: (V,), weight of the error at each vertex.
    """
    return _Collapsing(points, triangles, importance).down_to(count)


class _Collapsing:
    """The mesh while edges collapse: corners of each triangle, and the triangles at each vertex."""

    def __init__(self, points: Array, triangles: NDArray[np.int64], importance: Array) -> None:
        self._points = points
        self._weight = importance
        self._corners: dict[int, tuple[int, int, int]] = {
            t: (a, b, c) for t, (a, b, c) in enumerate(triangles.tolist())
        }
        self._at: dict[int, set[int]] = {}
        for number, corners in self._corners.items():
            for corner in corners:
                self._at.setdefault(corner, set()).add(number)
        self._quadrics = _quadrics(points, triangles, importance)
        self._fixed = _boundary(triangles)
        self._heap: list[tuple[float, int, int]] = []
        for vertex in self._at:
            self._offer(vertex)

    def down_to(self, count: int) -> NDArray[np.int64]:
        while len(self._corners) > count and self._heap:
            cost, gone, kept = heapq.heappop(self._heap)
            if gone not in self._at or kept not in self._at or kept not in self._neighbors(gone):
                continue
            if self._cost(gone, kept) > cost * (1 + 1e-9) or not self._possible(gone, kept):
                continue
            self._collapse(gone, kept)
        return np.array(list(self._corners.values()), np.int64).reshape(-1, 3)

    def _neighbors(self, vertex: int) -> set[int]:
        return {corner for number in self._at[vertex] for corner in self._corners[number]} - {vertex}

    def _cost(self, gone: int, kept: int) -> float:
        point = np.append(self._points[kept], 1.0)
        length = float(np.square(self._points[gone] - self._points[kept]).sum())
        quadric = self._quadrics[gone] + self._quadrics[kept]
        return float(point @ quadric @ point + _LENGTH_WEIGHT * self._weight[gone] * length**2)

    def _offer(self, vertex: int) -> None:
        """Put the collapses from and into a vertex on the heap, at their present cost."""
        for other in self._neighbors(vertex):
            for gone, kept in ((vertex, other), (other, vertex)):
                if gone not in self._fixed:
                    heapq.heappush(self._heap, (self._cost(gone, kept), gone, kept))

    def _possible(self, gone: int, kept: int) -> bool:
        """Whether the surface stays a manifold and no triangle turns over."""
        shared = self._at[gone] & self._at[kept]
        if len(shared) != 2 or len(self._neighbors(gone) & self._neighbors(kept)) != 2:
            return False
        for number in self._at[gone] - shared:
            before = self._points[list(self._corners[number])]
            after = self._points[[kept if corner == gone else corner for corner in self._corners[number]]]
            a, b = (np.cross(p[1] - p[0], p[2] - p[0]) for p in (before, after))
            lengths = float(np.linalg.norm(a) * np.linalg.norm(b))
            if float(a @ b) < _LEAST_COSINE * lengths or lengths < 1e-12:
                return False
        return True

    def _collapse(self, gone: int, kept: int) -> None:
        for number in self._at.pop(gone):
            corners = self._corners[number]
            if kept in corners:
                for corner in corners:
                    if corner != gone:
                        self._at[corner].discard(number)
                del self._corners[number]
            else:
                a, b, c = (kept if corner == gone else corner for corner in corners)
                self._corners[number] = (a, b, c)
                self._at[kept].add(number)
        self._quadrics[kept] += self._quadrics[gone]
        self._offer(kept)


def _quadrics(points: Array, triangles: NDArray[np.int64], importance: Array) -> Array:
    """(V, 4, 4): squared distance to the planes of the triangles at each vertex, weighted by area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    twice = np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    normal /= twice
    plane = np.concatenate([normal, -(normal * a).sum(axis=1, keepdims=True)], axis=1)
    of_triangle = plane[:, :, None] * plane[:, None, :] * twice[:, :, None] / 6
    quadrics = np.zeros((len(points), 4, 4))
    for k in range(3):
        np.add.at(quadrics, triangles[:, k], of_triangle * importance[triangles[:, k], None, None])
    return quadrics


def _boundary(triangles: NDArray[np.int64]) -> set[int]:
    """Vertices at edges that belong to a single triangle."""
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    edges, uses = np.unique(sides, axis=0, return_counts=True)
    return set(edges[uses == 1].ravel().tolist())
