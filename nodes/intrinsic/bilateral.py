"""The large-scale layer of a bilateral filter as shading."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.intrinsic.logarithm import finite_pixels, log_intensity, separated
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask


@node("intrinsic.bilateral")
def bilateral(
    photo: Image,
    mask: Mask | None = None,
    *,
    reach: Annotated[float, Field(gt=0, le=1)] = 0.04,
    contrast: Annotated[float, Field(gt=0, le=10)] = 0.4,
    floor: Annotated[float, Field(gt=0, le=1)] = 0.05,
) -> Intrinsic:
    """log s = the bilateral filter of the log intensity; what it smooths away is texture, hence albedo.

    Oh, Chen, Dorsey, Durand, Image-Based Modeling and Photo Editing, SIGGRAPH 2001. The filter runs on the bilateral
    grid of Chen, Paris, Durand, SIGGRAPH 2007: blurring a small volume of (place, intensity), at a cost that falls as
    `reach` grows.

    Args:
        mask: H x W, over which shading gets the mean of the intensity.
        reach: standard deviation in space, as a share of the longer side.
        contrast: standard deviation in log intensity; steps beyond it stay in the shading.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.bilateral")
    intensity = log_intensity(pixels)
    smooth = _grid_filtered(intensity, max(reach * max(intensity.shape), 1.0), contrast)
    return separated(pixels, smooth, mask, floor)


def _grid_filtered(values: FloatArray, reach: float, contrast: float) -> FloatArray:
    """Splat into a grid with one cell per standard deviation, blur by one cell, read back trilinearly."""
    from scipy.ndimage import gaussian_filter, map_coordinates

    height, width = values.shape
    rows = np.arange(height, dtype=np.float32)[:, None] / np.float32(reach) + 2
    columns = np.arange(width, dtype=np.float32)[None, :] / np.float32(reach) + 2
    levels = (values - values.min()) / np.float32(contrast) + 2
    shape = (int(rows[-1, 0]) + 4, int(columns[0, -1]) + 4, int(levels.max()) + 4)
    near = [np.broadcast_to(np.rint(c).astype(np.intp), values.shape).ravel() for c in (rows, columns, levels)]
    cell = np.ravel_multi_index((near[0], near[1], near[2]), shape)
    cells = int(np.prod(shape))
    total = np.bincount(cell, weights=values.ravel(), minlength=cells).reshape(shape)
    count = np.bincount(cell, minlength=cells).reshape(shape).astype(np.float64)
    total, count = gaussian_filter(total, 1, mode="constant"), gaussian_filter(count, 1, mode="constant")
    filtered = np.where(count > 1e-9, total / np.maximum(count, 1e-9), 0).astype(np.float32)
    weight = (count > 1e-9).astype(np.float32)
    places = np.stack([np.broadcast_to(c, values.shape) for c in (rows, columns, levels)])
    read, present = (map_coordinates(volume, places, order=1, mode="nearest") for volume in (filtered, weight))
    return np.where(present > 1e-3, read / np.maximum(present, 1e-3), values).astype(np.float32)
