"""The nine regions of detail transfer, and the eyes, nose and mouth that makeup leaves alone.

Regions are drawn once, on the mean face seen from the front, as soft masks in its own coordinates (`atlas`). The 468
points say which place of the mean face every pixel of a photo shows, so one look-up projects all regions to any face,
whatever its pose and expression. Left and right are the person's own.
"""

from __future__ import annotations

from dataclasses import fields, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.face_scale import face_scale
from graphface.nodes.morphable.facemesh import facemesh_mesh
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.rasterize import rasterized
from graphface.nodes.types import FloatArray, Image, Landmarks, Mask, Regions

SIDE, REACH = 384, 1.2
"""Pixels of the atlas' side, and the mean face's coordinate at its edge, inter-ocular distances."""


RIGHT_BROW = (70, 63, 105, 66, 107, 55, 65, 52, 53, 46)


RIGHT_EYE = (33, 246, 161, 160, 159, 158, 157, 173, 133, 155, 154, 153, 145, 144, 163, 7)


NOSE = (168, 193, 122, 196, 236, 198, 209, 129, 64, 98, 97, 2, 326, 327, 294, 358, 429, 420, 456, 419, 351, 417)


MOUTH = (61, 185, 40, 39, 37, 0, 267, 269, 270, 409, 291, 375, 321, 405, 314, 17, 84, 181, 91, 146)


RIGHT_CHEEK = (117, 118, 101, 36, 206, 216, 192, 213, 147, 123)


FOREHEAD = (54, 103, 67, 109, 10, 338, 297, 332, 284, 298, 333, 299, 337, 9, 108, 69, 104, 68)
"""Contours by FaceMesh's own vertex indices (MediaPipe's published topology); left ones are their mirror images."""


_FINEST = 100.0
"""Pixels per inter-ocular distance that regions are drawn with at the most; their edges are several of them wide."""


_GROW = {"brow": 0.03, "eye": 0.07, "nose": 0.02, "mouth": 0.06, "cheek": 0.08, "forehead": 0.03}
"""How far a region reaches beyond its contour, inter-ocular distances: an eye has lids."""


NAMES = tuple(field.name for field in fields(Regions))


def projected(drawn: list[FloatArray], photo: Image, landmarks: Landmarks) -> list[Mask]:
    """Maps of the atlas on a photo, H x W each; 0 off the face. They are soft, so a small copy of the photo will do."""
    copy = face_scale(landmarks, photo.pixels.shape, _FINEST)
    if copy.scale < 1:
        height, width = copy.size
        sides = np.array([width / photo.width, height / photo.height, copy.scale], np.float32)
        middle = np.array([0.5, 0.5, 0], np.float32)  # pixel centres are at whole numbers
        landmarks = replace(landmarks, points=(landmarks.points + middle) * sides - middle)
    x, y, covered = mean_face_coordinates(copy.size, landmarks)
    return [copy.up(_looked_up(map_, x, y) * covered) for map_ in drawn]


def mean_face_coordinates(size: tuple[int, int], landmarks: Landmarks) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Which place of the mean face each pixel shows: x, y in inter-ocular distances, and 1 where any; H x W."""
    mesh = facemesh_mesh(landmarks)
    surface = rasterized(mesh, size, smoothing=0)
    corners = facemesh_topology().mean[mesh.triangles]
    seen = np.maximum(surface.triangle, 0)
    x, y = (sum(surface.barycentric[..., k] * corners[:, k, axis][seen] for k in range(3)) for axis in (0, 1))
    return np.asarray(x, np.float32), np.asarray(y, np.float32), surface.coverage


@cache
def atlas(softness: float) -> dict[str, FloatArray]:
    """The regions on the mean face seen from the front, SIDE x SIDE each; where two meet they share."""
    contours = _contours()
    drawn = {}
    for name in NAMES:
        inside = _drawn(contours[name])
        depth = _signed_depth(inside) / SIDE * 2 * REACH + _GROW[name.rpartition("_")[2]]
        t = np.clip(depth / softness + 0.5, 0, 1)
        drawn[name] = (t * t * (3 - 2 * t)).astype(np.float32)
    total = np.maximum(sum(drawn.values()), 1)
    shared = {name: np.asarray(mask / total, np.float32) for name, mask in drawn.items()}
    for mask in shared.values():
        mask.setflags(write=False)
    return shared


def _contours() -> dict[str, NDArray[np.float32]]:
    topology = facemesh_topology()
    mirror = topology.mirror
    own = {"right_brow": RIGHT_BROW, "right_eye": RIGHT_EYE, "right_cheek": RIGHT_CHEEK}
    indices = {"nose": NOSE, "mouth": MOUTH, "forehead": FOREHEAD, **own}
    indices |= {name.replace("right", "left"): tuple(mirror[list(points)]) for name, points in own.items()}
    return {name: topology.mean[list(points), :2] for name, points in indices.items()}


def _drawn(contour: NDArray[np.float32]) -> NDArray[np.uint8]:
    import cv2

    pixels = np.stack(_places(contour[:, 0], contour[:, 1]), axis=1)
    canvas = np.zeros((SIDE, SIDE), np.uint8)
    cv2.fillPoly(canvas, [np.round(pixels * 16).astype(np.int32)], 1, shift=4)
    return canvas


def _signed_depth(inside: NDArray[np.uint8]) -> FloatArray:
    """Distance to the contour in pixels, positive inside."""
    import cv2

    within, beyond = (cv2.distanceTransform(m, cv2.DIST_L2, 5) for m in (inside, 1 - inside))
    return np.asarray(within - beyond, np.float32)


def _places(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean-face coordinates to the atlas' pixels."""
    half = np.float32((SIDE - 1) / 2)
    return half + x * (half / np.float32(REACH)), half - y * (half / np.float32(REACH))


def _looked_up(drawn: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    import cv2

    column, row = _places(x, y)
    return np.asarray(cv2.remap(drawn, column, row, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT), np.float32)
