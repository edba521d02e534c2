"""Places among texels."""

from __future__ import annotations

import cv2
import numpy as np

from graphface.nodes.types import FloatArray


def sampled(values: FloatArray, places: FloatArray) -> FloatArray:
    # With places in one map OpenCV wants None for the other, which its type stubs do not know.
    found = cv2.remap(values, places, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)  # type: ignore[call-overload]
    return np.asarray(found, np.float32)


def texels(uv: FloatArray, size: int) -> FloatArray:
    """Texture coordinates as places among texels, y down."""
    places: FloatArray = (np.stack([uv[..., 0], 1 - uv[..., 1]], axis=-1) * size - 0.5).astype(np.float32)
    return places
