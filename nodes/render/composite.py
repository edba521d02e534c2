"""New and old shading blended by what a pixel shows: face, hair or background (paper, section 3.1)."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Lazy, Needs, node
from graphface.nodes.render.scene import Scene
from graphface.nodes.types import FloatArray, Image, Segmentation, Shading

Percent = Annotated[float, Field(ge=0, le=100)]


def _wanted(scene: Scene) -> Needs:
    same = "the scene lights hair and background like the face (hair: 0, background: 1)"
    return {"labels": scene.labelled or same}


@node("render.composite", needs=_wanted)
def composite(
    estimated: Shading,
    relit: Shading,
    photo: Image,
    scene: Scene,
    labels: Lazy[Segmentation] = None,
    *,
    dull: Percent = 50.0,
    bright: Percent = 97.0,
) -> Shading:
    """The face takes the new shading, hair the old one at its bright pixels, the background a constant mixture.

    Hair looks like hair by its highlights, and those are no matter of the face's light. The blend is by soft labels,
    so that it is as smooth as they are.

    Args:
        estimated, relit: shading of the whole picture under the photo's own and the new light; H x W or H x W x 3.
        photo: tells the bright pixels of the hair; in the encoding of the shading.
        scene: `scene.hair` is kept of the old shading at the brightest hair, `scene.background` is the new one's share.
        labels: without them all counts as face.
        dull, bright: percentiles of the hair's intensity between which nothing and all of `scene.hair` is kept.

    Returns:
        estimated + share * (relit - estimated), float32, the more channels of the two.
    """
    if labels is None or not scene.labelled:
        return relit
    share = labels.face + np.float32(scene.background) * labels.background
    share += labels.hair * (1 - np.float32(scene.hair) * _brightness(photo, labels.hair, dull, bright))
    share = np.clip(share, 0, 1).astype(np.float32, copy=False)
    if relit.ndim == 3:
        share = share[..., None]
        estimated = estimated if estimated.ndim == 3 else estimated[..., None]
    mixed: Shading = estimated + share * (relit - estimated)
    return mixed


def _brightness(photo: Image, hair: FloatArray, dull: float, bright: float) -> FloatArray:
    """0 for dull to 1 for the brightest hair, H x W; 0 everywhere where there is no hair or it is all alike."""
    grey = photo.pixels.mean(axis=2, dtype=np.float32)
    of_hair = grey[hair > 0.5]
    if of_hair.size < 2:
        return np.zeros_like(grey)
    low, high = np.percentile(of_hair[:: max(1, of_hair.size // 20_000)], (dull, max(bright, dull)))
    t = np.clip((grey - np.float32(low)) / np.float32(max(high - low, 0.02)), 0, 1)
    return np.asarray(t * t * (3 - 2 * t), np.float32)
