"""Values at the sample points of a surface as maps: on the samples' grid, and enlarged to the picture."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray, Samples, Shadows


def on_grid(samples: Samples, values: FloatArray) -> FloatArray:
    """Values at the points as a map, continued by one cell beyond the surface; 0 elsewhere.

    Without the continuation, enlarging the map would darken it along the surface's edge.

    Args:
        values: float32 (n,) or (n, c).

    Returns:
        float32 h x w or h x w x c.
    """
    import cv2

    channels = values.shape[1:]
    flat = np.zeros((samples.grid[0] * samples.grid[1], *channels), np.float32)
    flat[samples.cells] = values
    map_ = flat.reshape(*samples.grid, *channels)
    sums = np.asarray(cv2.boxFilter(map_, -1, (3, 3), normalize=False, borderType=cv2.BORDER_CONSTANT))
    weights = samples.rim_weights.reshape(-1, *[1] * len(channels))
    flat[samples.rim] = sums.reshape(flat.shape).take(samples.rim, axis=0) * weights
    return map_


def enlarged(samples: Samples, map_: FloatArray) -> FloatArray:
    """A map of the grid, h x w (x c), at the picture's size, by bilinear interpolation: float32 H x W (x c)."""
    return _resized(map_, samples.picture)


def visible_shares(samples: Samples, shadows: Shadows | None) -> dict[int, FloatArray]:
    """The visible share (n,) of each shadow-casting light at the points, by the light's index in the scene."""
    if shadows is None:
        return {}
    maps = zip(shadows.lights, shadows.visible, strict=True)
    return {light: _resized(map_, samples.grid).reshape(-1).take(samples.cells) for light, map_ in maps}


def _resized(map_: FloatArray, size: tuple[int, int]) -> FloatArray:
    """Bilinear, to (height, width); the same object where that is its size."""
    import cv2

    if map_.shape[:2] == size:
        return map_
    return np.asarray(cv2.resize(map_, size[::-1], interpolation=cv2.INTER_LINEAR), np.float32)
