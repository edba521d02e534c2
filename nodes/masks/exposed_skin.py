"""Skin above the mesh: what goes on from the forehead without an edge, in nearly its color.

Between the brows and the hairline lies skin that no landmark covers, and the top of a normal mask is where hair is
learnt: a high forehead would be learnt as hair. It is told by going there: from the forehead's surely visible skin each
step upwards costs what the picture changes, and what differs from the forehead. Hair costs much, by its edge or by its
strands; skin next to nothing. A sum along a path moves little with noise, where a flooded region could jump.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.head_shape import EYE_LINE
from graphface.nodes.masks.prior import Layout
from graphface.nodes.types import FloatArray

BROW = EYE_LINE + 0.15
"""Height above which sure skin counts as forehead."""


LEAST = 12
"""Pixels of forehead below which nothing is told: under a fringe or a hat, or of a very small face."""


CALM = (0.3, 1.2)
"""Change per inter-ocular distance that is free: twice what this face's own skin shows, within these bounds.

Colors are in feature units: white is 1. A photo drawn sharp has rough skin, a soft one has soft hair.
"""


STEEP, STRANGE = 32.0, 8.0
"""Price of an inter-ocular distance through twice the calm change, and through a color a whole range off."""


LIGHTER, PALER, FULLER, ASIDE = 0.5, 0.08, 0.4, 0.15
"""How far skin may be off the forehead's color; a third of it is free.

In lightness; in less chroma; in more chroma of the same hue, as where a forehead turns into shadow; and across its hue.
Fair hair is paler or yellower than its skin. Set on portraits with fair and with dark hair, looking.
"""


REACH = 1.6
"""Longest way from the forehead, in inter-ocular distances."""


def bare_skin(values: FloatArray, skin: NDArray[np.bool_], layout: Layout, unit: float) -> FloatArray:
    """How surely each pixel above the eyes is skin that goes on from the forehead, float32 h x w in [0, 1].

    Args:
        values: features h x w x D, the first three of which are color: lightness and two that are 0 for grey, as in
            the default "lab". In other spaces (see `masks.features`) "hue" is read off other axes, and skin above the
            mesh is told less well; nothing fails.
        skin: what is surely skin.
        unit: inter-ocular distance in working pixels.

    Returns:
        1 where the cheapest way costs less than 1/4, 0 where it costs more than 3/4; 0 at and below the eyes, and all 0
        where no forehead shows.
    """
    import cv2

    forehead = skin & (layout.high > BROW)
    if np.count_nonzero(forehead) < LEAST:
        return np.zeros(skin.shape, np.float32)
    step = 1 / max(unit, 1.0)
    colors = np.asarray(cv2.GaussianBlur(values[..., :3], (0, 0), max(0.025 * unit, 0.5)), np.float32)
    price = step * _price(colors, skin, forehead, step)
    way = np.where(forehead, 0, 1e3).astype(np.float32)
    for _ in range(min(128, round(REACH * unit))):
        way = np.minimum(way, np.asarray(cv2.erode(way, np.ones((3, 3), np.uint8))) + price)
    return np.asarray(np.clip(1.5 - 2 * way, 0, 1) * (layout.high > EYE_LINE), np.float32)


def _price(colors: FloatArray, skin: NDArray[np.bool_], forehead: NDArray[np.bool_], step: float) -> FloatArray:
    """What an inter-ocular distance through each pixel costs; `step` is a pixel's width in that unit."""
    import cv2

    across, along = (cv2.Sobel(colors, cv2.CV_32F, dx, 1 - dx, scale=1 / 8) for dx in (1, 0))
    change = cv2.blur(np.sqrt((across**2 + along**2).sum(axis=2)), (3, 3)) / step
    middle = np.median(colors[forehead], axis=0)
    away, hue = colors - middle, middle[1:] / max(float(np.hypot(*middle[1:])), 1e-6)
    fuller, aside = away[..., 1:] @ hue, away[..., 1:] @ np.array([-hue[1], hue[0]])
    fuller = np.where(fuller > 0, fuller / FULLER, fuller / PALER)
    strange = np.hypot(away[..., 0] / LIGHTER, np.hypot(fuller, aside / ASIDE))
    steep = np.maximum(change / np.clip(2.0 * np.median(change[skin]), *CALM) - 1, 0)
    return np.asarray(STEEP * np.square(steep) + STRANGE * np.square(np.maximum(strange - 1 / 3, 0)), np.float32)
