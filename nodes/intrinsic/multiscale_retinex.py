"""Multi-scale retinex: log shading is the mean of the logarithms of a small, a middle and a large blur."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean
from graphface.nodes.intrinsic.log_domain import DARKEST, finite_pixels, intrinsic_images
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

SURROUNDS = (0.03, 0.15, 0.5)
"""Standard deviations as shares of the picture's longer side: 15, 80 and 250 of 512 pixels in the paper."""


_BLUR_PIXELS = 8.0
"""Standard deviation in pixels of the small copy on which a wide blur is computed."""


@node("intrinsic.multiscale_retinex")
def multiscale_retinex(
    photo: Image, mask: Mask | None = None, *, floor: Annotated[float, Field(gt=0, le=1)] = 0.05
) -> Intrinsic:
    """log s = sum_n w_n log(F_n * I) with equal weights w_n, I the intensity, F_n the Gaussian surrounds.

    Jobson, Rahman, Woodell, A Multiscale Retinex for Bridging the Gap Between Color Images and the Human Observation of
    Scenes, IEEE TIP 1997: their output log I - log s is the log albedo.

    Args:
        mask: H x W; over it shading gets the mean of the intensity.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.multiscale_retinex")
    intensity = np.maximum(channel_mean(pixels), 0)
    longest = max(intensity.shape)
    surrounds = [np.log(np.maximum(_blurred(intensity, share * longest), np.float32(DARKEST))) for share in SURROUNDS]
    return intrinsic_images(pixels, np.mean(surrounds, axis=0, dtype=np.float32), mask, floor)


def _blurred(values: FloatArray, sigma: float) -> FloatArray:
    """A wide Gaussian, computed on a copy in which it spans `_BLUR_PIXELS`, because it has no finer structure."""
    import cv2

    height, width = values.shape
    scale = min(1.0, _BLUR_PIXELS / max(sigma, 1e-3))
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    small = cv2.resize(values, size, interpolation=cv2.INTER_AREA)
    blurred = cv2.GaussianBlur(small, (0, 0), max(sigma * scale, 0.1), borderType=cv2.BORDER_REPLICATE)
    return np.asarray(cv2.resize(blurred, (width, height), interpolation=cv2.INTER_CUBIC), np.float32)
