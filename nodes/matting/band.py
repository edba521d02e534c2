"""Where alphas are unknown: a band along the borders between labels, wide where hair meets background."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray, Segmentation


@dataclass(frozen=True)
class Band:
    """The rectangle `part` of a photo that holds all `unknown` pixels (bool, of its size) and two more at each side."""

    part: tuple[slice, slice]
    unknown: NDArray[np.bool_]

    @property
    def empty(self) -> bool:
        return not self.unknown.any()


def band_of(labels: Segmentation, unit: float, *, width: float, strands: float) -> Band:
    """Pixels near a border of labels.

    Args:
        unit: the inter-ocular distance in pixels. width: of the band to each side of a border, in that unit.
        strands: the same where one of the labels is hair and the other background.
    """
    face, hair, background = (labels.face, labels.hair, labels.background)
    likeliest = np.stack([face, hair, background]).argmax(axis=0)
    ranges = [_near(likeliest == k, max(width * unit, 1.0)) for k in range(3)]
    unknown = (ranges[0] & ranges[1]) | (ranges[0] & ranges[2])
    reach = max(strands * unit, 1.0)
    unknown |= _near(likeliest == 1, reach) & _near(likeliest == 2, reach)
    return _cropped(unknown)


def likeliest_alphas(labels: Segmentation, part: tuple[slice, slice]) -> FloatArray:
    """Face and hair as 0 or 1 by the likeliest label, h x w x 2."""
    stacked = np.stack([labels.face[part], labels.hair[part], labels.background[part]])
    return np.asarray(stacked.argmax(axis=0)[..., None] == (0, 1), np.float32)


def soft_alphas(labels: Segmentation, band: Band) -> FloatArray:
    """Face and hair of the unknown pixels as the labels have them, (n, 2) in [0, 1]."""
    soft = np.stack([labels.face[band.part], labels.hair[band.part]], axis=2)[band.unknown]
    return np.clip(np.nan_to_num(soft), 0, 1)


def merged(labels: Segmentation, band: Band, alphas: FloatArray) -> Segmentation:
    """Certain labels outside of the band, alphas of face and hair (n, 2) in it, all within [0, 1] and summing to 1."""
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


def _cropped(unknown: NDArray[np.bool_], margin: int = 2) -> Band:
    rows, columns = np.flatnonzero(unknown.any(axis=1)), np.flatnonzero(unknown.any(axis=0))
    if not len(rows):
        return Band((slice(0, 0), slice(0, 0)), np.zeros((0, 0), bool))
    part = tuple(slice(max(0, int(i[0]) - margin), int(i[-1]) + 1 + margin) for i in (rows, columns))
    return Band(part, unknown[part])  # type: ignore[arg-type]
