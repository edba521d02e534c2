"""The two directions of every detail map: what it is measured against, and how it is put onto another rendering."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import Albedo, DetailMap, FloatArray, Shading


def rendering(albedo: Albedo, shading: Shading) -> FloatArray:
    """rho(x) s(x), H x W x 3, for a grey (H x W) or coloured (H x W x 3) shading."""
    if shading.ndim == 3:
        return albedo * shading
    rendered = in_three_channels(shading)
    rendered *= albedo
    return rendered


def in_three_channels(values: FloatArray) -> FloatArray:
    """H x W to H x W x 3, a new array; several times faster to multiply by than broadcasting to so short an axis."""
    import cv2

    if values.dtype != np.float32 or values.size == 0:
        return np.repeat(values[..., None], 3, axis=2)
    return np.asarray(cv2.cvtColor(values, cv2.COLOR_GRAY2RGB))


def applied(detail: DetailMap, rendered: FloatArray) -> FloatArray:
    """The picture that a detail map makes of a rendering, H x W x 3, unbounded; see `DetailMap` for the equation.

    `rendered` is used up: its memory serves as scratch.
    """
    beyond = None
    picture = rendered
    if detail.pivot is not None:
        picture = np.minimum(rendered, detail.pivot)
        beyond = np.subtract(rendered, picture, out=rendered)
    if detail.gain is not None:
        picture *= detail.gain
    picture += detail.offset
    if detail.ceiling is not None:
        np.minimum(picture, detail.ceiling, out=picture)
    if beyond is not None:
        picture += beyond
    return picture
