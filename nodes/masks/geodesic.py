"""Geodesic distance on the pixel grid: the least cost of any path from the seeds to each pixel.

A path goes from a pixel to any of its eight neighbors and pays the cost of each pixel that it enters. Distances are
found by relaxation (Bellman and Ford): each pixel takes the smallest distance among its neighbors plus its own cost,
for the whole picture at once, until nothing changes. A sum along a path changes little with noise. A threshold or a
flood fill can change its result at a single pixel.
"""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray


def geodesic_distance(start: FloatArray, cost: FloatArray, *, steps: int, tolerance: float = 0.0) -> FloatArray:
    """Least cost of a path to each pixel, float32 h x w.

    Args:
        start: h x w, the distance at the seeds; a large number elsewhere, which no path can exceed.
        cost: h x w, at least 0, of entering a pixel.
        steps: longest path, pixels.
        tolerance: the search also ends where one more step would change no distance by more than this.
    """
    import cv2

    neighborhood = np.ones((3, 3), np.uint8)
    distance = start
    for step in range(1, steps + 1):
        relaxed = np.minimum(distance, np.asarray(cv2.erode(distance, neighborhood), np.float32) + cost)
        if step % 8 == 0 and np.abs(relaxed - distance).max() <= tolerance:
            break
        distance = relaxed
    return distance
