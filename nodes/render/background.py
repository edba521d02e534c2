"""New and old shading mixed far from the face."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.face_scale import face_scale
from graphface.nodes.render.beyond import core_of, nearest_core, smooth_step
from graphface.nodes.types import Landmarks, Mask, Scene, Shading

Length = Annotated[float, Field(gt=0, le=10)]


Resolution = Annotated[int, Field(ge=8, le=256)]


@node("render.background")
def background(
    estimated: Shading,
    relit: Shading,
    mask: Mask,
    landmarks: Landmarks,
    scene: Scene,
    *,
    near: Annotated[float, Field(ge=0, le=10)] = 0.6,
    far: Length = 2.5,
    resolution: Resolution = 16,
) -> Shading:
    """Mix new and old shading far from the face, which the face's light says little about.

    Args:
        estimated, relit: both spread over the whole picture; H x W or H x W x 3.
        scene: `scene.background` is the share of the new shading far away.
        near, far: distances from the face, in inter-ocular distances, between which the share falls from 1 to that.

    Returns:
        `relit` at the face; further away estimated + share * (relit - estimated).
    """
    if scene.background == 1 or estimated is relit:
        return relit
    copy = face_scale(landmarks, mask.shape, resolution)
    core = core_of(copy.down(mask))
    if core is None:
        return relit
    _, distance = nearest_core(core)
    fall = smooth_step((distance / copy.interocular - near) / max(far - near, 1e-3))
    share = copy.up(1 - (1 - scene.background) * fall)
    if estimated.ndim < relit.ndim:
        estimated = estimated[..., None]
    mixed: Shading = estimated + share.reshape(*share.shape, *[1] * (relit.ndim - 2)) * (relit - estimated)
    return mixed
