"""The nine regions as soft masks in coordinates of the mean face, and their projection to a photo.

The masks are drawn once, on the mean face seen from the front. The 468 landmarks say which point of the mean face each
pixel of a photo shows, so one look-up projects all regions to any face in any pose and expression. Left and right are
the person's own.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.face_scale import face_scale
from graphface.nodes.morphable.facemesh import facemesh_mesh
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.rasterize import rasterized
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.types import REGIONS, FloatArray, Image, Landmarks, Mask

SIDE, REACH = 384, 1.2
"""Pixels of the atlas' side, and the mean face's coordinate at its edge, in inter-ocular distances."""


RIGHT_BROW = (70, 63, 105, 66, 107, 55, 65, 52, 53, 46)


RIGHT_EYE = (33, 246, 161, 160, 159, 158, 157, 173, 133, 155, 154, 153, 145, 144, 163, 7)


NOSE = (168, 193, 122, 196, 236, 198, 209, 129, 64, 98, 97, 2, 326, 327, 294, 358, 429, 420, 456, 419, 351, 417)


MOUTH = (61, 185, 40, 39, 37, 0, 267, 269, 270, 409, 291, 375, 321, 405, 314, 17, 84, 181, 91, 146)


RIGHT_CHEEK = (117, 118, 101, 36, 206, 216, 192, 213, 147, 123)


FOREHEAD = (54, 103, 67, 109, 10, 338, 297, 332, 284, 298, 333, 299, 337, 9, 108, 69, 104, 68)
"""Contours by FaceMesh's vertex indices (MediaPipe's published topology); left ones are their mirror images."""


FOREHEAD_WITH_FROWN = (54, 103, 67, 109, 10, 338, 297, 332, 284, 298, 333, 299, 336, 285, 8, 55, 107, 69, 104, 68)
"""The forehead down to the bridge of the nose: frown lines are not cut in two."""


_FINEST = 100.0
"""Pixels per inter-ocular distance that regions are drawn with at most; their soft edges are several of them wide."""


_GROWTH = {"brow": 0.03, "eye": 0.07, "nose": 0.02, "mouth": 0.06, "cheek": 0.08, "forehead": 0.03}
"""How far a region reaches beyond its contour, in inter-ocular distances: an eye includes its lids."""


_BROW_FALL = np.float32(4)
"""How much faster than the others a brow gets shallow outside: the skin beside it is the eye's or the forehead's."""


_FRACTION_BITS = 4
"""Of the fixed-point coordinates that OpenCV draws with."""


def projected(maps: list[FloatArray], photo: Image, landmarks: Landmarks) -> list[Mask]:
    """Maps of the atlas projected to a photo, H x W each; 0 off the face.

    They are soft, so they are drawn on a small copy of the photo and enlarged.
    """
    copy = face_scale(landmarks, photo.pixels.shape, _FINEST)
    if copy.scale < 1:
        height, width = copy.size
        scale = np.array([width / photo.width, height / photo.height, copy.scale], np.float32)
        half = np.array([0.5, 0.5, 0], np.float32)  # integer coordinates are pixel centres
        landmarks = replace(landmarks, points=(landmarks.points + half) * scale - half)
    x, y, covered = mean_face_coordinates(copy.size, landmarks)
    return [copy.up(_sampled(values, x, y) * covered) for values in maps]


def mean_face_coordinates(size: tuple[int, int], landmarks: Landmarks) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The point of the mean face at each pixel: x, y in inter-ocular distances, and the coverage; H x W each."""
    mesh = facemesh_mesh(landmarks)
    surface = rasterized(mesh, size, smoothing=0)
    corners = facemesh_topology().mean[mesh.triangles]
    triangle = np.maximum(surface.triangle, 0)
    x, y = (sum(surface.barycentric[..., k] * corners[:, k, axis][triangle] for k in range(3)) for axis in (0, 1))
    return np.asarray(x, np.float32), np.asarray(y, np.float32), surface.coverage


@cache
def atlas(softness: float, partition: bool = True) -> dict[str, FloatArray]:
    """The regions on the mean face seen from the front, SIDE x SIDE each, read-only; where two overlap they share.

    Args:
        softness: width of the ramp at the edge, in inter-ocular distances.
        partition: every point belongs to the region that it is deepest in, or nearest to, so that they sum to 1. False
            draws each within its contour, and what lies between the contours belongs to none.
    """
    contours = _contours(FOREHEAD_WITH_FROWN if partition else FOREHEAD)
    depths = {
        name: _signed_distance(_filled(contours[name])) / SIDE * 2 * REACH + _GROWTH[name.rpartition("_")[2]]
        for name in REGIONS
    }
    if partition:
        for name in ("left_brow", "right_brow"):
            depths[name] = np.where(depths[name] < 0, _BROW_FALL * depths[name], depths[name])
    # A region ends where it is `softness` less deep than the deepest, which itself has weight 1 before they share.
    start = np.maximum.reduce(list(depths.values())) - softness if partition else np.float32(-softness / 2)
    drawn = {name: smoothstep(np.asarray((depth - start) / softness, np.float32)) for name, depth in depths.items()}
    total = np.maximum(sum(drawn.values()), 1)
    shared = {name: np.asarray(mask / total, np.float32) for name, mask in drawn.items()}
    for mask in shared.values():
        mask.setflags(write=False)
    return shared


def _contours(forehead: tuple[int, ...]) -> dict[str, NDArray[np.float32]]:
    """Each region's polygon on the mean face, (n, 2)."""
    topology = facemesh_topology()
    right = {"right_brow": RIGHT_BROW, "right_eye": RIGHT_EYE, "right_cheek": RIGHT_CHEEK}
    indices = {"nose": NOSE, "mouth": MOUTH, "forehead": forehead, **right}
    indices |= {name.replace("right", "left"): tuple(topology.mirror[list(points)]) for name, points in right.items()}
    return {name: topology.mean[list(points), :2] for name, points in indices.items()}


def _filled(contour: NDArray[np.float32]) -> NDArray[np.uint8]:
    """The polygon drawn into the atlas: 1 inside, 0 outside."""
    import cv2

    pixels = np.stack(_atlas_pixels(contour[:, 0], contour[:, 1]), axis=1)
    canvas = np.zeros((SIDE, SIDE), np.uint8)
    cv2.fillPoly(canvas, [np.round(pixels * (1 << _FRACTION_BITS)).astype(np.int32)], 1, shift=_FRACTION_BITS)
    return canvas


def _signed_distance(inside: NDArray[np.uint8]) -> FloatArray:
    """Distance to the contour in pixels, positive inside."""
    import cv2

    within, beyond = (cv2.distanceTransform(m, cv2.DIST_L2, 5) for m in (inside, 1 - inside))
    return np.asarray(within - beyond, np.float32)


def _atlas_pixels(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Column and row in the atlas of coordinates of the mean face."""
    half = np.float32((SIDE - 1) / 2)
    return half + x * (half / np.float32(REACH)), half - y * (half / np.float32(REACH))


def _sampled(values: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    import cv2

    column, row = _atlas_pixels(x, y)
    return np.asarray(cv2.remap(values, column, row, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT), np.float32)
