"""Contact sheets: captioned pictures in a grid, for looking at what a graph does."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from graphface.nodes.pictures.photo import bytes_of
from graphface.nodes.types import Image, Landmarks, Mesh

Picture = NDArray[np.uint8]

_INK = (235, 235, 235)
_PAPER = 24
_CAPTION = 30


def contact_sheet(cells: Sequence[tuple[str, Picture]], *, columns: int, width: int = 360) -> Picture:
    """Pictures in a grid, each `width` pixels wide under its caption.

    Args:
        cells: caption and uint8 H x W x 3 RGB picture; all are scaled to the first one's aspect.
    """
    height = max(1, round(width * cells[0][1].shape[0] / cells[0][1].shape[1]))
    rows = -(-len(cells) // columns)
    sheet = np.full((rows * (height + _CAPTION), columns * (width + 4), 3), _PAPER, np.uint8)
    for index, (caption, picture) in enumerate(cells):
        top, left = (index // columns) * (height + _CAPTION), (index % columns) * (width + 4) + 2
        place = (left + 6, top + 20)
        cv2.putText(sheet, caption, place, cv2.FONT_HERSHEY_SIMPLEX, 0.5, _INK, 1, cv2.LINE_AA)
        shrinks = picture.shape[1] > width
        scaled = cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA if shrinks else cv2.INTER_LINEAR)
        sheet[top + _CAPTION : top + _CAPTION + height, left : left + width] = scaled
    return sheet


def around_face(landmarks: Landmarks, photo: Image, *, reach: float = 2.6) -> tuple[slice, slice]:
    """The part of a photo around the face, `reach` interocular distances to each side, with the photo's aspect."""
    points = landmarks.points[:, :2]
    x, y = (points.min(axis=0) + points.max(axis=0)) / 2
    half = min(1.0, 2 * reach * landmarks.interocular / max(1, min(photo.width, photo.height))) / 2
    wide, high = photo.width * half, photo.height * half
    left = round(min(max(x - wide, 0), photo.width - 2 * wide))
    top = round(min(max(y - high, 0), photo.height - 2 * high))
    return slice(top, top + max(1, round(2 * high))), slice(left, left + max(1, round(2 * wide)))


def mesh_overlay(photo: Image, mesh: Mesh, landmarks: Landmarks) -> Picture:
    """The projected triangles and landmarks drawn on the photo."""
    canvas = bytes_of(photo)
    points = mesh.camera.project(mesh.vertices)
    thickness = max(1, round(max(canvas.shape) / 1200))
    lines = np.round(points[mesh.triangles] * 16).astype(np.int32)
    cv2.polylines(canvas, list(lines), True, (80, 220, 160), thickness, cv2.LINE_AA, shift=4)
    for x, y in landmarks.points[:, :2]:
        cv2.circle(canvas, (round(float(x)), round(float(y))), thickness, (255, 200, 60), -1, cv2.LINE_AA)
    return canvas
