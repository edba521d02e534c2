"""Values of the reference resampled to the input's pixels, each interpolated once."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphface import node
from graphface.nodes.color import in_three_channels
from graphface.nodes.resample import resampled
from graphface.nodes.types import Albedo, Correspondence, DetailMap, Image, Mask, Paint, Shading


@node("warp.photo")
def photo(reference: Image, correspondence: Correspondence) -> Image:
    """The reference photo drawn onto the input's face, alpha dropped; see `resampled`."""
    return Image(resampled(reference.pixels, correspondence), encoding=reference.encoding)


@node("warp.albedo")
def albedo(reference: Albedo, correspondence: Correspondence) -> Albedo:
    """The reference's albedo at the input's pixels; see `resampled`."""
    return resampled(reference, correspondence)


@node("warp.mask")
def mask(reference: Mask, correspondence: Correspondence) -> Mask:
    """A mask of the reference at the input's pixels, 0..1; see `resampled`."""
    return np.asarray(np.clip(resampled(reference, correspondence), 0, 1), np.float32)


@node("warp.shading")
def shading(reference: Shading, correspondence: Correspondence) -> Shading:
    """The reference's shading at the input's pixels; see `resampled`."""
    return resampled(reference, correspondence)


@node("warp.detail")
def detail(reference: DetailMap, correspondence: Correspondence) -> DetailMap:
    """The reference's detail map, every part of it, at the input's pixels; see `resampled`."""
    parts = {name: v for name, v in vars(reference).items() if isinstance(v, np.ndarray)}
    return replace(reference, **{name: resampled(v, correspondence) for name, v in parts.items()})


@node("warp.paint")
def paint(reference: Paint, correspondence: Correspondence) -> Paint:
    """The reference's makeup at the input's pixels; see `resampled`."""
    layer = resampled(np.dstack([reference.departure, reference.opacity]), correspondence)
    known = np.minimum(correspondence.inside, 1)
    opacity = np.asarray(np.clip(layer[..., 3], 0, 1) * known, np.float32)
    departure = np.ascontiguousarray(layer[..., :3]) * in_three_channels(known)
    return replace(reference, opacity=opacity, departure=departure)
