"""The nearest face pixel of each pixel beyond the face, and means over cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray


def cell_means(values: FloatArray, cell: int) -> FloatArray:
    """Means over cells of so many pixels squared; what a cell has beyond the picture counts as 0."""
    import cv2

    height, width = values.shape[:2]
    rows, columns = -(-height // cell), -(-width // cell)
    padding = (0, rows * cell - height, 0, columns * cell - width)
    if any(padding):
        values = np.asarray(cv2.copyMakeBorder(values, *padding, cv2.BORDER_CONSTANT, value=0), np.float32)
    return np.asarray(cv2.resize(values, (columns, rows), interpolation=cv2.INTER_AREA), np.float32)


def core_of(weight: FloatArray) -> NDArray[np.bool_] | None:
    """The pixels that others copy: well inside the mask, or its best where it is faint everywhere; None: no mask."""
    most = float(weight.max())
    return weight >= min(0.5, most) if most > 1e-12 else None


def nearest_core(core: NDArray[np.bool_]) -> tuple[NDArray[np.intp], FloatArray]:
    """The place of each pixel's nearest core pixel, counted row by row, and the distance to it in pixels."""
    import cv2

    outside = (~core).astype(np.uint8)
    distance, labels = cv2.distanceTransformWithLabels(outside, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    place = np.zeros(int(labels.max()) + 1, np.intp)
    place[labels[core]] = np.flatnonzero(core)
    return place[labels], np.asarray(distance, np.float32)


def smooth_step(t: FloatArray) -> FloatArray:
    t = np.clip(t, 0, 1)
    return t * t * (3 - 2 * t)
