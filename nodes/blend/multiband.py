"""Burt and Adelson, A Multiresolution Spline With Application to Image Mosaics, ACM TOG 1983."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.types import FloatArray, Image, Landmarks, Mask


@node("blend.multiband")
def multiband(
    base: Image, layer: Image, mask: Mask, landmarks: Landmarks, *, reach: Annotated[float, Field(gt=0, le=2)] = 0.25
) -> Image:
    """Blend each band of a Laplacian pyramid by the mask's Gaussian pyramid: broad bands softly, fine ones sharply.

    Args:
        reach: width over which the broadest band is blended, in inter-ocular distances. Where the mask is 0 that far
            around, the base does not change by a bit.
    """
    import cv2

    if not mask.any():
        return base
    levels = max(1, min(8, round(np.log2(max(reach * landmarks.interocular, 2)))))
    levels = min(levels, max(1, int(np.log2(max(min(mask.shape), 2)))))
    change = layer.pixels - base.pixels
    pyramid, shares = [change], [mask]
    for _ in range(levels):
        pyramid.append(np.asarray(cv2.pyrDown(pyramid[-1], borderType=cv2.BORDER_REFLECT_101), np.float32))
        shares.append(np.asarray(cv2.pyrDown(shares[-1], borderType=cv2.BORDER_REFLECT_101), np.float32))
    blended = pyramid[-1] * shares[-1][..., None]
    for fine, coarse, share in zip(pyramid[-2::-1], pyramid[:0:-1], shares[-2::-1], strict=True):
        band = fine - _expanded(coarse, fine.shape)
        blended = _expanded(blended, fine.shape) + band * share[..., None]
    touched = _near(mask, 2**levels)
    return base.with_pixels(np.where(touched[..., None], base.pixels + blended, base.pixels))


def _expanded(values: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    """EXPAND of the paper: a level enlarged to the size of the finer one."""
    import cv2

    return np.asarray(cv2.pyrUp(values, dstsize=(shape[1], shape[0])), np.float32)


def _near(mask: Mask, radius: int) -> NDArray[np.bool_]:
    """Pixels with anything of the mask in the square of that radius around them."""
    import cv2

    side = 2 * radius + 1
    near: NDArray[np.bool_] = cv2.boxFilter(mask, -1, (side, side), normalize=False) > 1e-4
    return near
