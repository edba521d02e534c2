"""The two directions of every detail map: what it is measured against, and how it is put onto another rendering."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import Albedo, DetailMap, FloatArray, Shading


def rendering(albedo: Albedo, shading: Shading) -> FloatArray:
    """rho(x) s(x), H x W x 3, for a grey (H x W) or coloured (H x W x 3) shading."""
    return albedo * (shading if shading.ndim == 3 else shading[..., None])


def applied(detail: DetailMap, rendered: FloatArray) -> FloatArray:
    """The picture that a detail map makes of a rendering, H x W x 3, unbounded; see `DetailMap` for the equation."""
    if detail.gain is None:
        return rendered + detail.offset
    if detail.pivot is None:
        return detail.gain * rendered + detail.offset
    below = np.minimum(rendered, detail.pivot)
    picture: FloatArray = detail.gain * below
    picture += rendered
    picture -= below
    picture += detail.offset
    return picture
