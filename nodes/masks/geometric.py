"""Three masks from the projected geometry (paper, section 2): surely face, face and head, and all that may be face."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.head_shape import Points, cranium, ears, neck, pose_of
from graphface.nodes.landmark_schemes import IBUG68_IN_FACEMESH468
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.types import FloatArray, HeadMasks, Image, Landmarks, Surface

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
        landmarks: any scheme; they place the head that the face sits on.
        surface: the mesh in the picture; its coverage belongs to the normal mask.
        head: "solids" adds cranium and ears to a mesh of the face alone (see `head_shape`); "mesh" takes the mesh as it
            is, which is right where it is a whole head.
        shrink: how far the conservative mask stays inside the landmarks' outline.
        hairline: the conservative mask ends here, a height in the mean face's frame (eyes 0.34, top of the mesh 0.92):
            a fringe may cover what is above.
        expand: how far the aggressive mask reaches beyond the normal mask and the neck.

    Returns:
        Three nested masks of 0 and 1, float32 H x W.
    """
    shape = (photo.height, photo.width)
    pose = pose_of(landmarks)
    unit = max(landmarks.interocular, 1e-3)
    outline = filled([_hull(landmarks.points[:, :2])], shape)
    sure = filled([_hull(_below(landmarks, hairline))], shape)
    conservative = eroded(sure, shrink * unit)
    if not conservative.any():
        conservative = sure  # a face of a few pixels has no inside to spare
    solids = [cranium(pose), *ears(pose)] if head == "solids" else []
    normal = np.maximum(outline, surface.coverage > 0.5)
    normal = np.maximum(normal, filled(solids, shape))
    aggressive = dilated(np.maximum(normal, filled([neck(pose)], shape)), expand * unit)
    if not normal.any():
        warn("masks.geometric: the face lies outside of the picture or between its pixels; the masks are empty")
    return HeadMasks(np.minimum(conservative, normal), normal, aggressive)


def filled(polygons: Iterable[Points], shape: tuple[int, ...]) -> FloatArray:
    """Convex polygons of pixel coordinates, filled with 1; parts beyond the frame are cut, a speck keeps a pixel."""
    import cv2

    canvas = np.zeros(shape[:2], np.uint8)
    for polygon in polygons:
        if len(polygon) and np.isfinite(polygon).all() and np.abs(polygon).max() < 1 << 20:
            cv2.fillConvexPoly(canvas, np.round(polygon * 16).astype(np.int32), 1, cv2.LINE_8, 4)
    return canvas.astype(np.float32)


def eroded(mask: FloatArray, radius: float) -> FloatArray:
    """What lies deeper than `radius` pixels inside of a mask of 0 and 1; the frame is no edge."""
    return (_distance_within(mask > 0.5) > radius).astype(np.float32)


def dilated(mask: FloatArray, radius: float) -> FloatArray:
    """A mask of 0 and 1 grown by `radius` pixels."""
    return ((mask > 0.5) | ((_distance_within(mask <= 0.5) <= radius) & mask.any())).astype(np.float32)


def _distance_within(inside: NDArray[np.bool_]) -> FloatArray:
    """Distance of each inside pixel to the nearest one that is not; a large number where there is none."""
    import cv2

    if inside.all():
        return np.full(inside.shape, 1e9, np.float32)
    return np.asarray(cv2.distanceTransform(inside.astype(np.uint8), cv2.DIST_L2, 5), np.float32)


def _below(landmarks: Landmarks, height: float) -> NDArray[np.float32]:
    """The landmarks, (n, 2), that lie lower on the mean face than `height`."""
    mean = facemesh_topology().mean
    if landmarks.scheme == "ibug68":
        mean = mean[IBUG68_IN_FACEMESH468]
    return landmarks.points[mean[:, 1] <= height, :2]


def _hull(points: NDArray[np.float32]) -> Points:
    import cv2

    if not np.isfinite(points).all():
        return np.zeros((0, 2))
    hull: Points = cv2.convexHull(np.ascontiguousarray(points, np.float32)).reshape(-1, 2).astype(np.float64)
    return hull
