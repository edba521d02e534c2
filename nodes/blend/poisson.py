"""Pérez, Gangnet, Blake, Poisson Image Editing, SIGGRAPH 2003, in its screened form.

The layer's gradients are kept, and the base's values are met at the edge of the mask. Without screening that would undo
the new tone inside as well, which is the purpose of makeup. So the values are attracted to the layer's with a strength
that decays towards the edge (Bhat et al., Fourier Analysis of the 2D Screened Poisson Equation, ECCV 2008).
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.face_scale import face_scale
from graphface.nodes.types import FloatArray, Image, Landmarks, Mask


@node("blend.poisson")
def poisson(
    base: Image,
    layer: Image,
    mask: Mask,
    landmarks: Landmarks,
    *,
    reach: Annotated[float, Field(gt=0, le=2)] = 0.1,
    resolution: Annotated[int, Field(ge=8, le=256)] = 48,
    sweeps: Annotated[int, Field(ge=1, le=1000)] = 60,
) -> Image:
    """The layer inside of the mask's edge, with its own gradients across the edge.

    With h = layer - base, the correction c that is added to the layer solves laplace(c) = k c inside, and c = -h on the
    edge. It is smooth, so it is solved on a small copy.

    Args:
        reach: distance 1 / sqrt(k) over which the influence of the edge decays to 1/e, in inter-ocular distances.
        resolution: pixels per inter-ocular distance of the copy.
        sweeps: of Jacobi's method.
    """
    if not (mask > 0).any():
        return base
    change = mask[..., None] * (layer.pixels - base.pixels)
    copy = face_scale(landmarks, mask.shape, resolution)
    weight = copy.down(mask)
    screening = 1 / max(reach * copy.interocular, 0.5) ** 2
    correction = _screened(-copy.down(change), weight >= 0.5 * float(weight.max()), screening, sweeps)
    return base.with_pixels(base.pixels + change + mask[..., None] * copy.up(correction))


def _screened(edge: FloatArray, inside: NDArray[np.bool_], screening: float, sweeps: int) -> FloatArray:
    """laplace(c) = screening * c inside, c = edge outside, by Jacobi's method: each sweep divides the error by at least
    1 + screening / 4."""
    import cv2

    neighbours = np.array([[0, 1, 0], [1, 0, 1], [0, 1, 0]], np.float32)
    within = inside[..., None]
    c = np.where(within, 0, edge).astype(np.float32)
    for _ in range(sweeps):
        total = cv2.filter2D(c, -1, neighbours, borderType=cv2.BORDER_REPLICATE)
        c = np.where(within, total / np.float32(4 + screening), c).astype(np.float32)
    return c
