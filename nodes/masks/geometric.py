"""Three masks from the projected geometry (paper, section 2): surely face, face and head, and all that may be face."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.head_shape import convex_hull, cranium, ears, mean_face, neck, pose_of
from graphface.nodes.masks.polygons import dilated, eroded, filled
from graphface.nodes.types import HeadMasks, Image, Landmarks, Surface

Length = Annotated[float, Field(ge=0, le=4)]


@node("masks.geometric")
def geometric(
    photo: Image,
    landmarks: Landmarks,
    surface: Surface,
    *,
    head: Literal["solids", "mesh"] = "solids",
    shrink: Length = 0.06,
    hairline: Annotated[float, Field(ge=0, le=1.5)] = 0.72,
    expand: Length = 0.35,
) -> HeadMasks:
    """Conservative, normal and aggressive face masks; every length is in inter-ocular distances.

    Args:
        photo: gives the size, H x W; its pixels are not read.
        landmarks: any scheme; the head is posed by them.
        surface: the mesh in the picture; its coverage belongs to the normal mask.
        head: "solids" adds cranium and ears (see `head_shape`), for a mesh of the face alone; "mesh" adds nothing, for
            a mesh of a whole head.
        shrink: distance between the landmarks' outline and the conservative mask inside it.
        hairline: upper end of the conservative mask, a height in the mean face's frame (eyes 0.34, top of the mesh
            0.92): a fringe may cover the skin above.
        expand: distance between the normal mask with the neck and the edge of the aggressive mask outside.

    Returns:
        Three nested masks of 0 and 1, float32 H x W.
    """
    shape = (photo.height, photo.width)
    pose = pose_of(landmarks)
    unit = max(landmarks.interocular, 1e-3)
    outline = filled([convex_hull(landmarks.points[:, :2])], shape)
    below_hairline = filled([convex_hull(_below(landmarks, hairline))], shape)
    conservative = eroded(below_hairline, shrink * unit)
    if not conservative.any():
        conservative = below_hairline  # in a face of a few pixels erosion leaves nothing
    solids = [cranium(pose), *ears(pose)] if head == "solids" else []
    normal = np.maximum(outline, surface.coverage > 0.5)
    normal = np.maximum(normal, filled(solids, shape))
    aggressive = dilated(np.maximum(normal, filled([neck(pose)], shape)), expand * unit)
    if not normal.any():
        warn("masks.geometric: the face lies outside of the picture or between its pixels; the masks are empty")
    return HeadMasks(np.minimum(conservative, normal), normal, aggressive)


def _below(landmarks: Landmarks, height: float) -> NDArray[np.float32]:
    """The landmarks, (n, 2), that lie lower on the mean face than `height`."""
    return landmarks.points[mean_face(landmarks.scheme)[:, 1] <= height, :2]
