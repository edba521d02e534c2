"""The band of unknown alphas along the borders between labels. It is wide where hair meets background."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.bounding_box import Box, bounding_box
from graphface.nodes.types import FloatArray, Segmentation


@dataclass(frozen=True)
class Band:
    """The rectangle `part` of a photo that holds all `unknown` pixels, with a margin of two; `unknown` is bool, of its
    size."""

    part: Box
    unknown: NDArray[np.bool_]

    @property
    def empty(self) -> bool:
        return not self.unknown.any()


def band_of(labels: Segmentation, unit: float, *, width: float, hair_width: float) -> Band:
    """Pixels near a border of labels.

    Args:
        unit: the inter-ocular distance in pixels. width: of the band to each side of a border, in that unit.
        hair_width: the same where one of the labels is hair and the other background.
    """
    face, hair, background = (labels.face, labels.hair, labels.background)
    label = np.stack([face, hair, background]).argmax(axis=0)
    near_face, near_hair, near_background = (_near(label == k, max(width * unit, 1.0)) for k in range(3))
    unknown = near_face & (near_hair | near_background)
    reach = max(hair_width * unit, 1.0)
    unknown |= _near(label == 1, reach) & _near(label == 2, reach)
    part = bounding_box(unknown, margin=2) or (slice(0, 0), slice(0, 0))
    return Band(part, unknown[part])


def hard_alphas(labels: Segmentation, part: Box) -> FloatArray:
    """Face and hair as 0 or 1 by the most likely label, h x w x 2."""
    stacked = np.stack([labels.face[part], labels.hair[part], labels.background[part]])
    return np.asarray(stacked.argmax(axis=0)[..., None] == (0, 1), np.float32)


def soft_alphas(labels: Segmentation, band: Band) -> FloatArray:
    """Face and hair of the unknown pixels as in the labels, (n, 2) in [0, 1]."""
    soft = np.stack([labels.face[band.part], labels.hair[band.part]], axis=2)[band.unknown]
    return np.clip(np.nan_to_num(soft), 0, 1)


def with_alphas(labels: Segmentation, band: Band, alphas: FloatArray) -> Segmentation:
    """The most likely labels outside the band and alphas of face and hair (n, 2) inside it; they sum to 1."""
    stacked = np.stack([labels.face, labels.hair, labels.background], axis=2)
    stacked = np.asarray(stacked.argmax(axis=2)[..., None] == (0, 1, 2), np.float32)
    inside = np.clip(np.concatenate([alphas, 1 - alphas.sum(axis=1, keepdims=True)], axis=1), 0, 1)
    inside /= np.maximum(inside.sum(axis=1, keepdims=True), 1e-6)
    window = stacked[band.part]
    window[band.unknown] = inside
    return Segmentation(*(np.ascontiguousarray(stacked[..., k]) for k in range(3)))


def _near(mask: NDArray[np.bool_], reach: float) -> NDArray[np.bool_]:
    import cv2

    if not mask.any():
        return mask
    return np.asarray(cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, 5) <= reach)
