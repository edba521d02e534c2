"""Labels that the user gives, in place of computed ones."""

from __future__ import annotations

import numpy as np

from graphface import Lazy, Needs, node
from graphface.nodes.masks.given_mask import checked_masks, unless_all_given
from graphface.nodes.types import Mask, Segmentation


def _needs(face: Mask | None, hair: Mask | None, background: Mask | None) -> Needs:
    return unless_all_given(face=face, hair=hair, background=background)


@node("masks.given_labels", needs=_needs)
def given_labels(
    computed: Lazy[Segmentation],
    face: Mask | None = None,
    hair: Mask | None = None,
    background: Mask | None = None,
) -> Segmentation:
    """Labels with the given ones in their place; they sum to 1.

    Where given labels sum to more than 1 they are scaled down. What they leave is divided among the other, computed
    labels in proportion to these, and is background where these are 0.

    Raises:
        UsageError: a given mask is not of the photo's size, or a label is neither given nor computed.
    """
    given = {"face": face, "hair": hair, "background": background}
    if computed is not None and all(mask is None for mask in given.values()):
        return computed
    masks = checked_masks("masks.given_labels", given, computed.face.shape if computed is not None else None)
    total = np.asarray(sum(masks.values()), np.float32)
    labels = {name: np.asarray(mask / np.maximum(total, 1), np.float32) for name, mask in masks.items()}
    rest = np.maximum(1 - np.asarray(sum(labels.values()), np.float32), 0)
    others = {name: getattr(computed, name) for name in given if name not in labels}
    others_total = np.asarray(sum(others.values(), np.zeros_like(total)), np.float32)
    labels |= {name: rest * mask / np.maximum(others_total, 1e-6) for name, mask in others.items()}
    left = np.maximum(1 - np.asarray(sum(labels.values()), np.float32), 0)
    return Segmentation(labels["face"], labels["hair"], labels["background"] + left)
