"""The hair of the brows, which is the person's own and no paint."""

from __future__ import annotations

import numpy as np

from graphface.nodes.blur import gaussian
from graphface.nodes.color import lab
from graphface.nodes.disc import disc
from graphface.nodes.types import FloatArray

_REACH = 0.045
"""How far brows lie beyond the outline of the landmarks, in inter-ocular distances."""


_LID = 0.075
"""Distance from the eyes' openings, in inter-ocular distances, up to which nothing is a brow."""


_DARK, _RAMP = 0.12, 0.15
"""Natural logarithms by which hair is darker than skin at the least, and over which it becomes certain; with dark brows
both are shares of their own darkness, so that a shadow beneath is no brow."""


_LEAST_PIXELS = 9
"""Of certain hair that tell the color and the darkness of the brows."""


_COLOR = 0.12
"""Difference of chroma from the brow's own, in natural logarithms: shadow beneath a brow has another color."""


def brow_hair(
    pixels: FloatArray, departure: FloatArray, brows: FloatArray, eyes: FloatArray, unit: float
) -> FloatArray:
    """1 on hair of the brows, 0 elsewhere, h x w.

    Args:
        pixels: h x w x 3, encoded. departure: logarithm of their ratio to bare skin, smoothed, h x w x 3.
        brows, eyes: masks of the landmarks' outlines. unit: pixels between the eyes.
    """
    import cv2

    zone = np.asarray(cv2.dilate((brows > 0.3).astype(np.float32), disc(max(1, _REACH * unit))), np.float32)
    zone *= 1 - cv2.dilate((eyes > 0.3).astype(np.float32), disc(max(1, _LID * unit)))
    zone = gaussian(zone, 0.015 * unit)
    light = departure.mean(axis=2)
    color = lab(pixels)
    certain = (brows > 0.6) & (light < -0.3)
    darkness = max(float(np.median(-light[certain])), 0.0) if certain.sum() >= _LEAST_PIXELS else 0.0
    least, ramp = max(_DARK, 0.4 * darkness), max(_RAMP, 0.3 * darkness)
    hair = zone * np.clip((-light - least) / ramp, 0, 1)
    # Hair is neither blue nor strongly colored: a painted brow is paint.
    hair *= np.clip((color[..., 2] + 9) / 5, 0, 1) * np.clip((38 - np.hypot(color[..., 1], color[..., 2])) / 8, 0, 1)
    if darkness > 0:
        chroma = departure - light[..., None]
        apart = np.linalg.norm(chroma - np.median(chroma[certain], axis=0), axis=2)
        hair *= np.clip(2.5 - apart / _COLOR, 0, 1)
    return np.asarray(hair, np.float32)
