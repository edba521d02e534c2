"""The nearest face pixel of each pixel beyond the face (paper, section 4.1), and means over blocks of pixels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray


def block_means(values: FloatArray, side: int) -> FloatArray:
    """Means over blocks of `side` x `side` pixels; what a block has beyond the picture counts as 0.

    Args:
        values: float32 H x W or H x W x c.

    Returns:
        float32, ceil(H / side) x ceil(W / side) (x c).
    """
    import cv2

    height, width = values.shape[:2]
    rows, columns = -(-height // side), -(-width // side)
    padding = (0, rows * side - height, 0, columns * side - width)
    if any(padding):
        values = np.asarray(cv2.copyMakeBorder(values, *padding, cv2.BORDER_CONSTANT, value=0), np.float32)
    return np.asarray(cv2.resize(values, (columns, rows), interpolation=cv2.INTER_AREA), np.float32)


def face_core(mask: FloatArray) -> NDArray[np.bool_] | None:
    """The pixels that are copied outwards: where the mask is at least 0.5, or at its maximum where that is lower.

    None where the mask is empty.
    """
    largest = float(mask.max())
    return mask >= min(0.5, largest) if largest > 1e-12 else None


def nearest_pixel(core: NDArray[np.bool_]) -> tuple[NDArray[np.intp], FloatArray]:
    """The nearest pixel of `core` to each pixel: its row-major index, intp H x W, and the distance in pixels, H x W."""
    import cv2

    outside = (~core).astype(np.uint8)
    distance, labels = cv2.distanceTransformWithLabels(outside, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    index = np.zeros(int(labels.max()) + 1, np.intp)
    index[labels[core]] = np.flatnonzero(core)
    return index[labels], np.asarray(distance, np.float32)
