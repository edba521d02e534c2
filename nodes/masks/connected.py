"""Labels that are connected to this head. Other hair and skin belong to other people, or are a collar or a wall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.disc import disc
from graphface.nodes.head_shape import CHIN, EYE_LINE
from graphface.nodes.masks.geodesic import geodesic_distance
from graphface.nodes.masks.layout import Layout
from graphface.nodes.masks.prior import BACKDROP, FACE, HAIR
from graphface.nodes.types import FloatArray

MIN_WIDTH = 0.06
"""Narrowest strip of hair that connects more hair to the head, in inter-ocular distances."""


GAP_COST = 8.0
"""Cost per inter-ocular distance of a path through pixels that surely do not have the label."""


NECK_COST, NECK_MARGIN = 8.0, 0.15
"""Cost of a path through hair, per inter-ocular distance and per inter-ocular distance that the path lies inside the
neck, counted from this margin outside of it. Locks of hair fall beside the neck. Something that is connected to the
head only across the throat is a collar or a suit."""


MAX_STEPS = 400
"""Longest path, working pixels."""


@dataclass(frozen=True)
class Seeds:
    """Where paths start, bool h x w: `hair` (the top of the `head`) for hair, `skin` for face."""

    head: NDArray[np.bool_]
    hair: NDArray[np.bool_]
    skin: NDArray[np.bool_]


def seeds_of(layout: Layout) -> Seeds:
    """The pixels that surely belong to this head, from its geometry alone."""
    head = (layout.head < 0) & (layout.up > CHIN + 0.5)
    return Seeds(head, head & (layout.up > EYE_LINE), (layout.outline < 0) | (layout.neck < 0) | head)


def connected(
    probabilities: FloatArray, layout: Layout, unit: float, prior: tuple[FloatArray, FloatArray] | None
) -> FloatArray:
    """Probabilities without the parts that are not connected to the head, h x w x 4.

    Disconnected hair becomes skin at the throat and background elsewhere; disconnected face becomes background. A
    connection narrower than `MIN_WIDTH` does not count: the shadow of a jaw may join a dark suit to dark hair.

    Args:
        prior: probabilities of face and hair in a prior segmentation. Where that is certain of a label, the label needs
            no connection: the segmentation has seen the whole head, and a lock behind a shadow is connected by so
            little that noise would cut it off.
    """
    probabilities = probabilities.copy()
    seeds = seeds_of(layout)
    throat = (layout.outline < 0.05) | ((layout.neck < 0.05) & (layout.up > CHIN - 0.3))
    depth_in_neck = np.maximum(NECK_MARGIN - layout.neck, 0)
    neck_cost = NECK_COST * depth_in_neck * (layout.outline > 0) * (layout.up < CHIN + 0.3)
    for label, start, always_kept, extra_cost in (
        (HAIR, seeds.hair, seeds.head, neck_cost),
        (FACE, seeds.skin, seeds.skin, np.zeros_like(neck_cost)),
    ):
        apart = disconnected(probabilities[..., label], start, unit, extra_cost)
        removed = probabilities[..., label] * apart * ~always_kept
        if prior is not None:
            removed *= np.clip(1 - 2 * prior[label], 0, 1)
        probabilities[..., label] -= removed
        to_skin = throat if label == HAIR else np.zeros_like(throat)
        probabilities[..., FACE] += removed * to_skin
        probabilities[..., BACKDROP] += removed * ~to_skin
    return probabilities


def disconnected(
    probability: FloatArray, seeds: NDArray[np.bool_], unit: float, extra_cost: FloatArray | None = None
) -> FloatArray:
    """How surely each pixel of a label is not connected to the seeds, float32 h x w in [0, 1].

    This is a ramp of the geodesic distance from the seeds, where each step costs the square of 1 - probability: 0 at a
    distance of 1/4 and less, 1 at 3/4 and more.

    Args:
        probability: of the label, h x w in [0, 1].
        seeds: bool h x w.
        unit: inter-ocular distance in pixels.
        extra_cost: h x w, added to the cost per inter-ocular distance.
    """
    import cv2

    narrow = disc(MIN_WIDTH * unit / 2)
    # Eroding the probability cuts strips that are too narrow; eroding the distance gives the rim back.
    lacking = np.square(1 - np.asarray(cv2.erode(probability, narrow, borderType=cv2.BORDER_REPLICATE), np.float32))
    cost = np.asarray((GAP_COST * lacking + (0 if extra_cost is None else extra_cost)) / max(unit, 1.0), np.float32)
    start = np.where(seeds, 2 * lacking, 9).astype(np.float32)
    distance = geodesic_distance(start, cost, steps=MAX_STEPS, tolerance=1e-3)
    distance = np.asarray(cv2.erode(distance, narrow, iterations=2), np.float32)
    return np.asarray(np.clip(2 * distance - 0.5, 0, 1), np.float32)
