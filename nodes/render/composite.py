"""New and old shading blended by what a pixel shows: face, hair or background (paper, section 3.1)."""

from __future__ import annotations

import numpy as np

from graphface import Lazy, Needs, node
from graphface.nodes.color import in_three_channels
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Mask, Scene, Segmentation, Shading


def _wanted(scene: Scene) -> Needs:
    return {
        "labels": scene.background != 1 or "the scene lights the background like the face (background: 1)",
        "shine": scene.hair != 0 or "the scene lights hair like the face (hair: 0)",
        "response": scene.background != 1 or "without labels all is lit like the face (background: 1)",
    }


@node("render.composite", needs=_wanted)
def composite(
    estimated: Shading,
    relit: Shading,
    scene: Scene,
    labels: Lazy[Segmentation] = None,
    shine: Lazy[Mask] = None,
    response: Lazy[Mask] = None,
) -> Shading:
    """The face takes the new shading, hair the old one at its bright pixels, the background a constant mixture.

    Hair looks like hair by its highlights, and those are no matter of the face's light. The blend is by soft labels, so
    that it is as smooth as they are.

    Args:
        estimated, relit: shading of the whole picture under the photo's own and the new light; H x W or H x W x 3.
        scene: `scene.hair` is kept of the old shading at the brightest hair, `scene.background` is the new one's share.
        labels, shine: without them all counts as face.
        response: `render.response`, H x W; without it added light counts in full everywhere.

    Returns:
        estimated + share * (relit - estimated), float32, the more channels of the two.
    """
    if labels is None and shine is None:
        return relit
    mixed = np.empty(estimated.shape if estimated.ndim > relit.ndim else relit.shape, np.float32)

    def strip(rows: slice) -> None:
        before = _like(estimated[rows], mixed)
        change = _like(relit[rows], mixed) - before
        change *= _like(_new_share(scene, labels, shine, rows), mixed)
        if response is not None:
            # Only what is added: max(change, 0) * response + min(change, 0)
            less = np.minimum(change, 0)
            np.maximum(change, 0, out=change)
            change *= _like(response[rows], mixed)
            change += less
        np.add(before, change, out=mixed[rows])

    by_strips(strip, mixed.shape)
    return mixed


def _like(values: FloatArray, mixed: Shading) -> FloatArray:
    """A grey map in three channels where the result has them."""
    return in_three_channels(values) if values.ndim < mixed.ndim else values


def _new_share(scene: Scene, labels: Segmentation | None, shine: Mask | None, rows: slice) -> FloatArray:
    """How much of the new light each pixel takes, H x W."""
    kept = np.zeros(0, np.float32)
    if labels is not None:
        kept = np.float32(1 - scene.background) * labels.background[rows]
    if shine is not None:
        shining = np.float32(scene.hair) * shine[rows]
        kept = kept + shining if labels is not None else shining
    np.minimum(kept, 1, out=kept)
    return np.subtract(1, kept, out=kept)
