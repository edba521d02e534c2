"""How much light dark skin takes before what lies in it shows: noise, the blocks of a JPEG file, crushed blacks.

Relative to its brightness, skin has the same texture in light and in shadow. Dark pixels of a photograph often have
several times as much: noise, the blocks of the file, the contrast of a steep tone curve. Added light multiplies all
three. So the texture of each photo is measured by brightness. Path-traced heads and clean photos take all the light.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from graphface.nodes.blur import blurred
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.face_scale import face_scale
from graphface.nodes.types import FloatArray, Landmarks, Mask

_LEVELS = (0.0, 0.04, 0.06, 0.08, 0.1, 0.12, 0.15)
"""Bounds of the brightnesses that are looked at. Skin above the last is lit in full, whatever its texture, or
hard shadows on dark skin stay (seven Yale faces lit from the side, relit frontally: squared error 0.0138 as it is,
0.0127 where all skin is lit in full)."""

_RESOLUTION, _SIGMA = 100, 1.5
"""Pixels between the eyes on the copy that is looked at, and the scale of texture on it: .015 of that distance."""

_SKIN = 0.5
"""Of the mask, for pixels that count."""

_FEWEST, _LEAST_SHARE = 60, 0.005
"""Pixels of a brightness, and share of the skin, from which its texture is known. The edge of a shadow has fewer."""

_LEAST = np.float32(5e-3)


def rough_below(brightness: FloatArray, skin: Mask, landmarks: Landmarks, rougher: float) -> float:
    """The brightness, 0 to 0.15, below which the texture of skin is more than `rougher` times that of lit skin.

    Args:
        brightness: of the photo, H x W. skin: H x W.
    """
    copy = face_scale(landmarks, brightness.shape, _RESOLUTION)
    weight = copy.down(skin)
    window = bounding_box(weight > _SKIN)
    if window is None:
        return 0.0
    weight, level = weight[window], copy.down(brightness)[window]
    smooth = blurred(level * weight, _SIGMA) / np.maximum(blurred(weight, _SIGMA), _LEAST)
    on = weight > _SKIN
    smooth, level = smooth[on], level[on]
    texture = np.abs(level - smooth) / np.maximum(smooth, _LEAST)
    lit = float(np.median(texture[smooth >= np.median(smooth)]))
    found = 0.0
    fewest = max(_FEWEST, _LEAST_SHARE * len(smooth))
    for low, high in pairwise(_LEVELS):
        here = (smooth >= low) & (smooth < high)
        if np.count_nonzero(here) >= fewest and np.median(texture[here]) > rougher * lit:
            found = high
    return found
