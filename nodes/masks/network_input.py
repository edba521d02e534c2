"""What the label network is shown of a photo: colors against this face's skin, texture, and where the head lies.

Distances to the solids of the head (see `masks.prior.Layout`) align every face with every other, so that few photos
teach a lot; colors are told against the sure skin of this very face, and as they are.
"""

from __future__ import annotations

import numpy as np

from graphface import warn
from graphface.nodes.masks.prior import Layout
from graphface.nodes.masks.upright import HEIGHT, WIDTH
from graphface.nodes.types import FloatArray

COLORS, ROUGH, PLACE, SKIN, CHANNELS = 0, 12, 16, 22, 25
"""Where each kind of channel begins: colors and roughness of a cell's four pixels, the place, the skin's color."""


RIGHT = PLACE + 3


SKIN_TOP = 0.6
"""Height in the mean face's frame below which skin is sure: a fringe may hang above."""


FAR = 1.5
"""Distances in inter-ocular distances from which on they are all the same."""


LIGHTNESS, CHROMA, ROUGHNESS = 0.03, 0.05, 8.0
"""Factors that bring Lab and the spread of lightness (white is 1) to ranges of about 1."""


LEAST_SPREAD = 0.01
"""Added to the local spread of lightness, in squares: a level of noise on flat ground changes nothing."""


USUAL_SKIN = (60.0, 16.0, 18.0)
"""Lab of the skin where none is sure: the middle of portraits."""


def shown(pixels: FloatArray, seen: FloatArray, layout: Layout) -> FloatArray:
    """The network's input, float32 HEIGHT/2 x WIDTH/2 x CHANNELS: four colors and textures a cell, one place.

    Args:
        pixels: HEIGHT x WIDTH x 3, sRGB within [0, 1] and finite, of the upright grid.
        seen: HEIGHT x WIDTH, 1 within the photo. layout: of the grid.
    """
    import cv2

    lab = np.asarray(cv2.cvtColor(pixels, cv2.COLOR_RGB2Lab), np.float32)
    scale = np.asarray([LIGHTNESS, CHROMA, CHROMA], np.float32)
    skin = _skin_color(lab, seen, layout)
    color = (lab - skin) * scale * seen[..., None]
    rough = _roughness(np.asarray(lab[..., 0] / 100, np.float32)) * seen
    cells = [_unshuffled(color), _unshuffled(rough[..., None])]
    distances = [np.clip(d, -FAR, FAR) for d in (layout.outline, layout.head, layout.neck)]
    place = np.stack([*distances, layout.right / 3, layout.high / 3, seen], axis=2)
    size = (WIDTH // 2, HEIGHT // 2)
    cells.append(np.asarray(cv2.resize(place, size, interpolation=cv2.INTER_AREA), np.float32))
    inside = cells[-1][..., -1:]
    cells.append(inside * (skin - np.asarray(USUAL_SKIN, np.float32)) * scale)
    return np.concatenate(cells, axis=2, dtype=np.float32)


def mirror_image(cells: FloatArray) -> FloatArray:
    """The same of the mirrored picture: the pixels of each cell change places, and what was right is left."""
    cells = cells[:, ::-1].copy()
    for first, channels in ((COLORS, 3), (ROUGH, 1)):
        part = cells[..., first : first + 4 * channels]
        part[...] = part.reshape(*part.shape[:2], 2, 2, channels)[:, :, :, ::-1].reshape(part.shape)
    cells[..., RIGHT] *= -1
    return cells


def _skin_color(lab: FloatArray, seen: FloatArray, layout: Layout) -> FloatArray:
    """Median Lab of what is surely skin."""
    sure = (layout.outline < -0.06) & ~layout.features & (layout.high < SKIN_TOP) & (seen > 0.5)
    if not sure.any():
        warn("masks.cue: no skin in sight; colors are compared with the usual one")
        return np.asarray(USUAL_SKIN, np.float32)
    return np.asarray(np.median(lab[sure], axis=0), np.float32)


def _roughness(lightness: FloatArray) -> FloatArray:
    """Spread of lightness (white is 1) within 3 x 3 pixels of the grid: strands have it, skin and walls do not."""
    import cv2

    mean, square = (cv2.blur(m, (3, 3)) for m in (lightness, lightness * lightness))
    spread = np.sqrt(np.maximum(square - mean * mean, 0) + LEAST_SPREAD**2) - LEAST_SPREAD
    return np.asarray(ROUGHNESS * spread, np.float32)


def _unshuffled(values: FloatArray) -> FloatArray:
    """2h x 2w x C to h x w x 4C: the four pixels of a cell side by side."""
    height, width, channels = values.shape
    cells = values.reshape(height // 2, 2, width // 2, 2, channels).transpose(0, 2, 1, 3, 4)
    return cells.reshape(height // 2, width // 2, 4 * channels)
