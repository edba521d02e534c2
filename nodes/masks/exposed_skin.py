"""Exposed skin above the mesh: a forehead that continues upwards without an edge, in nearly the same color.

No landmark covers the skin between the brows and the hairline, and hair is learned from the top of the normal mask: a
high forehead would be learned as hair. This skin is found by its geodesic distance from the part of the forehead that
is surely visible. A path pays for changes of the picture and for colors unlike the forehead's. Hair costs much, by its
edge or by its strands. Skin costs next to nothing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.head_shape import EYE_LINE
from graphface.nodes.masks.geodesic import geodesic_distance
from graphface.nodes.masks.layout import Layout
from graphface.nodes.types import FloatArray

FOREHEAD_HEIGHT = EYE_LINE + 0.15
"""Height in the face's own axes above which visible skin counts as forehead."""


MIN_FOREHEAD_PIXELS = 12
"""With fewer pixels of forehead no skin is found: under a fringe or a hat, or in a very small face."""


FREE_GRADIENT = (0.3, 1.2)
"""A gradient (change per inter-ocular distance) costs nothing up to twice the median gradient of this face's skin,
within these bounds. Colors are in feature units: white is 1. A sharpened photo has rough skin; a soft one has soft
hair.
"""


GRADIENT_COST, COLOR_COST = 32.0, 8.0
"""Cost per inter-ocular distance of a gradient of twice the free one, and of a color distance of 4/3 (see `_cost`)."""


LIGHTNESS_RANGE, LOWER_CHROMA_RANGE, HIGHER_CHROMA_RANGE, HUE_RANGE = 0.5, 0.08, 0.4, 0.15
"""Differences from the forehead's color that count as 1; the first third costs nothing.

In lightness; in less chroma; in more chroma of the same hue, as where a forehead turns into shadow; across the hue.
Fair hair has less chroma than its skin, or is yellower. Set by eye, on portraits with fair and with dark hair.
"""


REACH = 1.6
"""Longest path from the forehead, in inter-ocular distances."""


def exposed_skin(values: FloatArray, skin: NDArray[np.bool_], layout: Layout, unit: float) -> FloatArray:
    """How surely each pixel above the eyes is skin that continues the forehead, float32 h x w in [0, 1].

    Args:
        values: features h x w x D, the first three of which are color: lightness and two that are 0 for grey, as in
            the default "lab". In other spaces (see `masks.features`) chroma and hue are measured along other axes, and
            the result is less exact.
        skin: what is surely skin.
        unit: inter-ocular distance in working pixels.

    Returns:
        A ramp of the geodesic distance: 1 up to 1/4, 0 from 3/4 on; 0 at and below the eyes, and 0 everywhere where no
        forehead is visible.
    """
    import cv2

    forehead = skin & (layout.up > FOREHEAD_HEIGHT)
    if np.count_nonzero(forehead) < MIN_FOREHEAD_PIXELS:
        return np.zeros(skin.shape, np.float32)
    step = 1 / max(unit, 1.0)
    colors = np.asarray(cv2.GaussianBlur(values[..., :3], (0, 0), max(0.025 * unit, 0.5)), np.float32)
    cost = step * _cost(colors, skin, forehead, step)
    start = np.where(forehead, 0, 1e3).astype(np.float32)
    distance = geodesic_distance(start, cost, steps=min(128, round(REACH * unit)))
    return np.asarray(np.clip(1.5 - 2 * distance, 0, 1) * (layout.up > EYE_LINE), np.float32)


def _cost(colors: FloatArray, skin: NDArray[np.bool_], forehead: NDArray[np.bool_], step: float) -> FloatArray:
    """Cost per inter-ocular distance of a path through each pixel; `step` is a pixel's width in that unit."""
    import cv2

    down, right = (cv2.Sobel(colors, cv2.CV_32F, dx, 1 - dx, scale=1 / 8) for dx in (0, 1))
    gradient = cv2.blur(np.sqrt((right**2 + down**2).sum(axis=2)), (3, 3)) / step
    free_gradient = np.clip(2.0 * np.median(gradient[skin]), *FREE_GRADIENT)
    excess_gradient = np.maximum(gradient / free_gradient - 1, 0)

    median = np.median(colors[forehead], axis=0)
    difference, hue = colors - median, median[1:] / max(float(np.hypot(*median[1:])), 1e-6)
    chroma, across_hue = difference[..., 1:] @ hue, difference[..., 1:] @ np.array([-hue[1], hue[0]])
    chroma = np.where(chroma > 0, chroma / HIGHER_CHROMA_RANGE, chroma / LOWER_CHROMA_RANGE)
    color_distance = np.hypot(difference[..., 0] / LIGHTNESS_RANGE, np.hypot(chroma, across_hue / HUE_RANGE))
    excess_color = np.maximum(color_distance - 1 / 3, 0)
    return np.asarray(GRADIENT_COST * np.square(excess_gradient) + COLOR_COST * np.square(excess_color), np.float32)
