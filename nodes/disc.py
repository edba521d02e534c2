"""The disc by which masks are dilated and pictures closed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def disc(radius: float) -> NDArray[np.uint8]:
    """A structuring element for OpenCV's morphology, 2 r + 1 pixels wide; radius 0 is the pixel alone.

    >>> disc(1).tolist()
    [[0, 1, 0], [1, 1, 1], [0, 1, 0]]
    """
    import cv2

    side = 2 * round(max(radius, 0)) + 1
    return np.asarray(cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side)), np.uint8)
