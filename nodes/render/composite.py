"""New and old shading blended by label: face, hair or background (paper, section 4.1)."""

from __future__ import annotations

import numpy as np

from graphface import Lazy, Needs, node
from graphface.nodes.color import with_channels_of
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Mask, Scene, Segmentation, Shading


def _needs(scene: Scene) -> Needs:
    return {
        "labels": scene.background != 1
        or scene.local
        or "the scene lights the background like the face (background: 1)",
        "shine": scene.hair != 0 or "the scene lights hair like the face (hair: 0)",
        "wall": (scene.background > 0 and scene.local) or "no lamp of the scene is near, or it lights no background",
        "lamps": scene.background > 0 or "the scene does not light the background (background: 0)",
    }


@node("render.composite", needs=_needs)
def composite(
    estimated: Shading,
    relit: Shading,
    scene: Scene,
    labels: Lazy[Segmentation] = None,
    shine: Lazy[Mask] = None,
    response: Mask | None = None,
    lamps: Lazy[Mask] = None,
    wall: Lazy[Shading] = None,
) -> Shading:
    """The face gets the new shading, the background a constant mixture, bright hair keeps more of the old shading.

    Bright pixels of hair are specular highlights, which keep hair looking like hair. The labels are soft, so the blend
    is as smooth as they are.

    Args:
        estimated, relit: shading of the whole picture under the photo's own and the new light; H x W or H x W x 3.
        scene: `scene.hair` is the share of the old shading that the brightest hair keeps, `scene.background` the share
            of the new shading on the background.
        labels, shine: without them all pixels count as face.
        response: see `render.response`, H x W; it scales the light that is added, and without it nothing does.
        wall: the new shading on the background (`render.wall`), of the shape of `relit`, which counts without it.
        lamps: what gives light itself, H x W; it keeps the old shading.

    Returns:
        estimated + share * (relit - estimated), float32; three channels if either shading has three.
    """
    masks = labels is not None or shine is not None or lamps is not None
    if not masks and response is None:
        return relit
    mixed = np.empty(estimated.shape if estimated.ndim > relit.ndim else relit.shape, np.float32)

    def strip(rows: slice) -> None:
        share = share_of_new(scene, labels, shine, lamps, rows) if masks else None
        after = relit[rows]
        if wall is not None and labels is not None:
            after = with_wall(after, wall[rows], labels.background[rows])
        mixed[rows] = blended(estimated[rows], after, share, None if response is None else response[rows])

    by_strips(strip, mixed.shape)
    return mixed


def with_wall(relit: FloatArray, wall: FloatArray, background: FloatArray) -> FloatArray:
    """The shading of the head, n x W or n x W x 3, and that of the wall on the background, n x W."""
    farther = wall - with_channels_of(relit, wall)
    farther *= with_channels_of(background, farther)
    farther += with_channels_of(relit, farther)
    return farther


def blended(before: FloatArray, after: FloatArray, share: FloatArray | None, response: FloatArray | None) -> FloatArray:
    """before + share * (after - before), and what is added times `response`; None stands for 1.

    Args:
        before, after: n x W or n x W x 3. share, response: n x W.

    Returns:
        A new array, with three channels if either shading has three.
    """
    like = before if before.ndim > after.ndim else after
    before = with_channels_of(before, like)
    change = with_channels_of(after, like) - before
    if share is not None:
        change *= with_channels_of(share, change)
    if response is not None:
        # max(change, 0) * response + min(change, 0)
        removed = np.minimum(change, 0)
        np.maximum(change, 0, out=change)
        change *= with_channels_of(response, change)
        change += removed
    change += before
    return change


def share_of_new(
    scene: Scene, labels: Segmentation | None, shine: Mask | None, lamps: Mask | None, rows: slice = slice(None)
) -> FloatArray:
    """The share of the new shading at each pixel of the rows; at least one of the three masks is there."""
    keeping = [(shine, scene.hair), (lamps, 1.0)]
    if labels is not None:
        keeping.append((labels.background, 1 - scene.background))
    kept = [np.float32(share) * mask[rows] for mask, share in keeping if mask is not None]
    total = np.asarray(sum(kept), np.float32)
    np.minimum(total, 1, out=total)
    return np.subtract(1, total, out=total)
