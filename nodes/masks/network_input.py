"""The input of the label network: colors relative to this face's skin, texture, and the geometry of the head.

Distances to the solids of the head (see `masks.layout`) align every face with every other, so few photos are enough to
train on. Colors are relative to the surely visible skin of the face; the skin's own color is an input too.
"""

from __future__ import annotations

import numpy as np

from graphface import warn
from graphface.nodes.masks.layout import Layout
from graphface.nodes.masks.upright_grid import HEIGHT, WIDTH
from graphface.nodes.types import FloatArray

COLORS, ROUGHNESS, GEOMETRY, SKIN, CHANNELS = 0, 12, 16, 22, 25
"""First channel of each kind: colors and roughness of a cell's four pixels, geometry, the skin's color; the count."""


RIGHT = GEOMETRY + 3
"""The channel with the position to the right of the face's middle."""


SKIN_TOP = 0.6
"""Height in the face's axes up to which skin is surely visible; a fringe may hang above."""


MAX_DISTANCE = 1.5
"""Distances are clipped to this, in inter-ocular distances."""


LIGHTNESS_SCALE, CHROMA_SCALE, ROUGHNESS_SCALE = 0.03, 0.05, 8.0
"""Factors that bring Lab and the standard deviation of lightness (white is 1) to ranges of about 1."""


NOISE_FLOOR = 0.01
"""Standard deviation of lightness that is added in squares, so that noise of one 8-bit level changes nothing."""


AVERAGE_SKIN = (60.0, 16.0, 18.0)
"""Lab of the skin where none is visible: the median of portraits."""


def network_input(pixels: FloatArray, inside: FloatArray, layout: Layout) -> FloatArray:
    """The network's input, float32 HEIGHT/2 x WIDTH/2 x CHANNELS: one vector for each cell of 2 x 2 pixels.

    Args:
        pixels: HEIGHT x WIDTH x 3, sRGB within [0, 1] and finite, of the upright grid.
        inside: HEIGHT x WIDTH, 1 within the photo. layout: of the grid.
    """
    import cv2

    lab = np.asarray(cv2.cvtColor(pixels, cv2.COLOR_RGB2Lab), np.float32)
    scale = np.asarray([LIGHTNESS_SCALE, CHROMA_SCALE, CHROMA_SCALE], np.float32)
    skin = _skin_color(lab, inside, layout)
    color = (lab - skin) * scale * inside[..., None]
    roughness = _roughness(np.asarray(lab[..., 0] / 100, np.float32)) * inside
    distances = [np.clip(d, -MAX_DISTANCE, MAX_DISTANCE) for d in (layout.outline, layout.head, layout.neck)]
    geometry = np.stack([*distances, layout.right / 3, layout.up / 3, inside], axis=2)
    geometry = np.asarray(cv2.resize(geometry, (WIDTH // 2, HEIGHT // 2), interpolation=cv2.INTER_AREA), np.float32)
    skin_channels = geometry[..., -1:] * (skin - np.asarray(AVERAGE_SKIN, np.float32)) * scale
    channels = [_pixel_unshuffled(color), _pixel_unshuffled(roughness[..., None]), geometry, skin_channels]
    return np.concatenate(channels, axis=2, dtype=np.float32)


def mirrored_input(cells: FloatArray) -> FloatArray:
    """The input of the mirrored picture: the two pixels of each row of a cell change places, and right becomes left."""
    cells = cells[:, ::-1].copy()
    for first, channels in ((COLORS, 3), (ROUGHNESS, 1)):
        part = cells[..., first : first + 4 * channels]
        part[...] = part.reshape(*part.shape[:2], 2, 2, channels)[:, :, :, ::-1].reshape(part.shape)
    cells[..., RIGHT] *= -1
    return cells


def _skin_color(lab: FloatArray, inside: FloatArray, layout: Layout) -> FloatArray:
    """Median Lab of the surely visible skin."""
    visible = (layout.outline < -0.06) & ~layout.features & (layout.up < SKIN_TOP) & (inside > 0.5)
    if not visible.any():
        warn("masks.cue: no skin is visible; colors are compared with average skin")
        return np.asarray(AVERAGE_SKIN, np.float32)
    return np.asarray(np.median(lab[visible], axis=0), np.float32)


def _roughness(lightness: FloatArray) -> FloatArray:
    """Standard deviation of lightness (white is 1) within 3 x 3 pixels of the grid: hair is rough, skin and walls are
    not."""
    import cv2

    mean, square = (cv2.blur(m, (3, 3)) for m in (lightness, lightness * lightness))
    deviation = np.sqrt(np.maximum(square - mean * mean, 0) + NOISE_FLOOR**2) - NOISE_FLOOR
    return np.asarray(ROUGHNESS_SCALE * deviation, np.float32)


def _pixel_unshuffled(values: FloatArray) -> FloatArray:
    """2h x 2w x C to h x w x 4C: the four pixels of a cell side by side."""
    height, width, channels = values.shape
    cells = values.reshape(height // 2, 2, width // 2, 2, channels).transpose(0, 2, 1, 3, 4)
    return cells.reshape(height // 2, width // 2, 4 * channels)
