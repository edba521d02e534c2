"""New and old shading mixed by the distance from the face."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.face_scale import face_scale
from graphface.nodes.render.nearest_face import face_core, nearest_pixel
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.types import Landmarks, Mask, Scene, Shading


@node("render.background")
def background(
    estimated: Shading,
    relit: Shading,
    mask: Mask,
    landmarks: Landmarks,
    scene: Scene,
    *,
    near: Annotated[float, Field(ge=0, le=10)] = 0.6,
    far: Annotated[float, Field(gt=0, le=10)] = 2.5,
    resolution: Annotated[int, Field(ge=8, le=256)] = 16,
) -> Shading:
    """Keep more of the old shading far from the face, where the light of the face is a poor estimate.

    Args:
        estimated, relit: both spread over the whole picture; H x W or H x W x 3.
        scene: `scene.background` is the share of the new shading far away.
        near, far: distances from the face, in inter-ocular distances, between which the share falls from 1 to
            `scene.background`.
        resolution: pixels per inter-ocular distance of the copy on which distances are measured.

    Returns:
        estimated + share * (relit - estimated), float32.
    """
    if scene.background == 1 or estimated is relit:
        return relit
    copy = face_scale(landmarks, mask.shape, resolution)
    core = face_core(copy.down(mask))
    if core is None:
        return relit
    _, distance = nearest_pixel(core)
    falloff = smoothstep((distance / copy.interocular - near) / max(far - near, 1e-3))
    share = copy.up(1 - (1 - scene.background) * falloff)
    if estimated.ndim < relit.ndim:
        estimated = estimated[..., None]
    mixed: Shading = estimated + share.reshape(*share.shape, *[1] * (relit.ndim - 2)) * (relit - estimated)
    return mixed
