"""Burt and Adelson, A Multiresolution Spline With Application to Image Mosaics, ACM TOG 1983."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.types import FloatArray, Image, Landmarks, Mask


@node("blend.multiband")
def multiband(
    base: Image, layer: Image, mask: Mask, landmarks: Landmarks, *, reach: Annotated[float, Field(gt=0, le=2)] = 0.25
) -> Image:
    """Each band of spatial frequency is mixed over a distance that suits it: broad tones softly, fine texture sharply.

    Args:
        reach: width over which the broadest band is mixed, in inter-ocular distances. Beyond it (and where the mask was
            0 that far around) the base is untouched.
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
    mixed = pyramid[-1] * shares[-1][..., None]
    for fine, share in zip(pyramid[-2::-1], shares[-2::-1], strict=True):
        band = fine - _enlarged(_reduced(fine), fine.shape)
        mixed = _enlarged(mixed, fine.shape) + band * share[..., None]
    touched = _dilated(mask, 2**levels)
    return base.with_pixels(np.where(touched[..., None], base.pixels + mixed, base.pixels))


def _reduced(values: FloatArray) -> FloatArray:
    import cv2

    return np.asarray(cv2.pyrDown(values, borderType=cv2.BORDER_REFLECT_101), np.float32)


def _enlarged(values: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    import cv2

    return np.asarray(cv2.pyrUp(values, dstsize=(shape[1], shape[0])), np.float32)


def _dilated(mask: Mask, radius: int) -> np.ndarray[tuple[int, int], np.dtype[np.bool_]]:
    import cv2

    size = 2 * radius + 1
    near: np.ndarray[tuple[int, int], np.dtype[np.bool_]] = (
        cv2.boxFilter(mask, -1, (size, size), normalize=False) > 1e-4
    )
    return near
