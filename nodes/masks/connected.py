"""What hangs on this head: hair and skin that do not are another's, a collar or a wall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.head_shape import CHIN, EYE_LINE
from graphface.nodes.masks.prior import BACKDROP, FACE, HAIR, Layout
from graphface.nodes.types import FloatArray

STRIP = 0.06
"""Width of the thinnest hair that can carry more hair, in inter-ocular distances."""


GAP = 8.0
"""Price of an inter-ocular distance through what is surely no hair, on the way from the head to a lock."""


COLLAR, INWARDS = 8.0, 0.15
"""Price of an inter-ocular distance through hair, for each that the way lies inside of the neck, counted from this far
outside of it. Locks fall beside the neck; what hangs on the head only by way of the throat is a collar or a suit."""


WAYS = 400
"""Longest way that is looked for, working pixels."""


@dataclass(frozen=True)
class Roots:
    """Where ways along a label start, h x w: on the top of the `head` for `hair`, on `skin` for face."""

    head: NDArray[np.bool_]
    hair: NDArray[np.bool_]
    skin: NDArray[np.bool_]


def roots(layout: Layout) -> Roots:
    """What of the head's solids surely is this head's."""
    head = (layout.head < 0) & (layout.high > CHIN + 0.5)
    return Roots(head, head & (layout.high > EYE_LINE), (layout.outline < 0) | (layout.neck < 0) | head)


def connected(
    belief: FloatArray, layout: Layout, unit: float, told: tuple[FloatArray, FloatArray] | None
) -> FloatArray:
    """Hair that does not hang on the head becomes skin or background, face that does not hang on the face background.

    What hangs by a strip thinner than `STRIP` does not hang: the shadow of a jaw may tie a dark suit to dark hair.

    Args:
        told: a cue's probabilities of face and hair. What it is sure of needs not hang: it saw the whole head, and a
            lock behind a shadow hangs by so little that noise would cut it off.
    """
    belief = belief.copy()
    hangs_on = roots(layout)
    throat = (layout.outline < 0.05) | ((layout.neck < 0.05) & (layout.high > CHIN - 0.3))
    collar = COLLAR * np.maximum(INWARDS - layout.neck, 0) * (layout.outline > 0) * (layout.high < CHIN + 0.3)
    for label, root, stays, toll in (
        (HAIR, hangs_on.hair, hangs_on.head, collar),
        (FACE, hangs_on.skin, hangs_on.skin, np.zeros_like(collar)),
    ):
        stray = belief[..., label] * apart(belief[..., label], root, unit, toll) * ~stays
        if told is not None:
            stray *= np.clip(1 - 2 * told[label], 0, 1)
        belief[..., label] -= stray
        shadow = throat if label == HAIR else np.zeros_like(throat)
        belief[..., FACE] += stray * shadow
        belief[..., BACKDROP] += stray * ~shadow
    return belief


def apart(belief: FloatArray, root: NDArray[np.bool_], unit: float, toll: FloatArray | None = None) -> FloatArray:
    """How surely each pixel of a label does not hang on the root, float32 h x w in [0, 1].

    The cheapest way from the root is found, on which every step costs the square of what belief lacks of 1. A part of
    the label hangs on the root where that is less than 1/4, and does not where it is more than 3/4. A sum along a way
    moves little with noise, where a threshold would cut a thin lock off at one pixel.

    Args:
        belief: h x w in [0, 1]. root: where ways start. unit: inter-ocular distance in pixels.
        toll: h x w, what an inter-ocular distance costs beside that.
    """
    import cv2

    thin = max(0, round(STRIP * unit / 2))
    element = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * thin + 1, 2 * thin + 1))
    lacking = np.square(1 - np.asarray(cv2.erode(belief, element, borderType=cv2.BORDER_REPLICATE), np.float32))
    price = np.asarray((GAP * lacking + (0 if toll is None else toll)) / max(unit, 1.0), np.float32)
    way = np.where(root, 2 * lacking, 9).astype(np.float32)
    for step in range(1, WAYS + 1):
        shorter = np.minimum(way, np.asarray(cv2.erode(way, np.ones((3, 3), np.uint8))) + price)
        if step % 8 == 0 and np.abs(shorter - way).max() < 1e-3:
            break
        way = shorter
    way = np.asarray(cv2.erode(way, element, iterations=2), np.float32)
    return np.asarray(np.clip(2 * way - 0.5, 0, 1), np.float32)
