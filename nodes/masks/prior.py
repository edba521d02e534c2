"""The prior over classes: where face, hair and background are to be expected, from the geometry of the face alone.

There are four classes: background is the backdrop beside the head and the clothes below it, since a dark suit says
nothing about the backdrop behind dark hair. Scores are piecewise linear in distances from the solids of `head_shape`,
in inter-ocular distances. The numbers were set by eye on portraits. They matter only where color and texture say
little.
"""

from __future__ import annotations

import numpy as np

from graphface.nodes.head_shape import CHIN, EYE_LINE
from graphface.nodes.masks.layout import Layout
from graphface.nodes.masks.logits import log_softmax
from graphface.nodes.types import FloatArray

FACE, HAIR, BACKDROP, CLOTHES = range(4)


def log_prior(layout: Layout) -> FloatArray:
    """log p(class) of each pixel, float32 h x w x 4, in the order FACE, HAIR, BACKDROP, CLOTHES."""
    up, side = layout.up, np.abs(layout.right)
    below_chin = np.maximum(CHIN - up, 0)
    above_eyes = np.maximum(up - EYE_LINE, 0)

    scalp = np.where(up > EYE_LINE, np.minimum(layout.head, 0.0), 1.0)
    skin = np.minimum(layout.outline, layout.neck + 0.1 + 0.25 * below_chin)
    ear = np.where(up > EYE_LINE + 0.25, 1.0, layout.head + 0.05)
    slope = np.where(below_chin > 0, 3.5, 6.0)  # shoulders may be bare
    face = 2.0 - slope * np.clip(np.minimum(skin, ear), 0, 1) - 3.0 * above_eyes * (layout.outline > 0)
    face = np.where(scalp < 0, np.maximum(face, -1.0), face)

    # Long hair falls beside the face and onto the shoulders. Above the eyes it stays near the skull.
    beside = np.where(below_chin > 0, np.maximum(side - 1.1, 0), np.maximum(layout.head, 0))
    hair = 1.5 - np.where(up > EYE_LINE, 2.6, 1.5) * beside - 0.5 * below_chin
    inner = np.maximum(-layout.outline, 0)
    hair -= np.where(up > EYE_LINE + 0.2, 4.0, 12.0) * inner
    hair -= 5.0 * np.clip(1.2 * (0.75 - side), 0, 1) * ((layout.neck < 0) & (layout.outline > 0))

    body = np.minimum(layout.head, layout.neck + 0.05)
    backdrop = np.clip(0.5 + 3.0 * body, -4, 1.5) - 1.5 * np.clip(below_chin * 2 - side, 0, 1.5)
    clothes = np.clip(-3 + 5.0 * (below_chin - 0.35 + 0.15 * np.minimum(side, 1)), -8, 2.0)
    clothes -= np.where(layout.neck < 0, 1.0, 0.0) * np.clip(1.2 - below_chin * 1.5, 0, 1)
    return log_softmax(np.stack([face, hair, backdrop, clothes], axis=2).astype(np.float32))
