"""The large-scale layer of a bilateral filter as shading."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.intrinsic.log_domain import finite_pixels, intrinsic_images, log_intensity
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

_MARGIN = 2
"""Empty cells around the grid, so that its blur stays inside."""


@node("intrinsic.bilateral")
def bilateral(
    photo: Image,
    mask: Mask | None = None,
    *,
    spatial_sigma: Annotated[float, Field(gt=0, le=1), Formerly("reach")] = 0.04,
    range_sigma: Annotated[float, Field(gt=0, le=10), Formerly("contrast")] = 0.4,
    floor: Annotated[float, Field(gt=0, le=1)] = 0.05,
) -> Intrinsic:
    """log s is the bilateral filter of the log intensity; the texture that it removes is albedo.

    Oh, Chen, Dorsey, Durand, Image-Based Modeling and Photo Editing, SIGGRAPH 2001. The filter is a blur in the
    bilateral grid of position and intensity (Chen, Paris, Durand, Real-Time Edge-Aware Image Processing with the
    Bilateral Grid, SIGGRAPH 2007), whose cost falls with `spatial_sigma`.

    Args:
        mask: H x W; over it shading gets the mean of the intensity.
        spatial_sigma: standard deviation in the picture, as a share of the longer side.
        range_sigma: standard deviation in log intensity; larger steps stay in the shading.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.bilateral")
    intensity = log_intensity(pixels)
    smooth = _grid_filtered(intensity, max(spatial_sigma * max(intensity.shape), 1.0), range_sigma)
    return intrinsic_images(pixels, smooth, mask, floor)


def _grid_filtered(values: FloatArray, spatial_sigma: float, range_sigma: float) -> FloatArray:
    """Splat into a grid with one cell per standard deviation, blur by one cell, read back trilinearly.

    Args:
        values: H x W. spatial_sigma: in pixels. range_sigma: in the unit of `values`.
    """
    from scipy.ndimage import gaussian_filter, map_coordinates

    height, width = values.shape
    rows = np.arange(height, dtype=np.float32)[:, None] / np.float32(spatial_sigma) + _MARGIN
    columns = np.arange(width, dtype=np.float32)[None, :] / np.float32(spatial_sigma) + _MARGIN
    levels = (values - values.min()) / np.float32(range_sigma) + _MARGIN
    shape = tuple(int(last) + 2 * _MARGIN for last in (rows[-1, 0], columns[0, -1], levels.max()))
    cells = [np.broadcast_to(np.rint(c).astype(np.intp), values.shape).ravel() for c in (rows, columns, levels)]
    index = np.ravel_multi_index((cells[0], cells[1], cells[2]), shape)
    size = int(np.prod(shape))
    total = np.bincount(index, weights=values.ravel(), minlength=size).reshape(shape)
    count = np.bincount(index, minlength=size).reshape(shape).astype(np.float64)
    total, count = gaussian_filter(total, 1, mode="constant"), gaussian_filter(count, 1, mode="constant")
    filtered = np.where(count > 1e-9, total / np.maximum(count, 1e-9), 0).astype(np.float32)
    occupied = (count > 1e-9).astype(np.float32)
    positions = np.stack([np.broadcast_to(c, values.shape) for c in (rows, columns, levels)])
    read, weight = (map_coordinates(volume, positions, order=1, mode="nearest") for volume in (filtered, occupied))
    return np.where(weight > 1e-3, read / np.maximum(weight, 1e-3), values).astype(np.float32)
