"""Faces that one run of the detector misses.

BlazeFace was trained on pictures of a phone's camera. It needs a margin around a face, misses faces smaller than about
a twelfth of the picture, and detects only heads that are roughly upright. So several views of the photo are tried in
turn: as it is, with a border, in tiles, rotated. The first group of views with a confirmed face ends the search.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeVar

import cv2
import numpy as np

from graphface import warn
from graphface.nodes.landmarks.blazeface import Face, Range, detect
from graphface.nodes.network_pixels import network_pixels
from graphface.nodes.types import FloatArray, Image

LONG_SIDE = 1600
"""Longest side of the copy that is searched; the networks see 256 pixels of it, or of a tile."""


SURE = 0.75
"""Detector score from which a face in the first view ends the search. Measured: whole faces 0.74 and more, parts of a
face up to 0.64."""


T = TypeVar("T")


@dataclass(frozen=True)
class View:
    """One view of the picture: `matrix` (2, 3) maps the view's pixels to the picture's."""

    name: str
    pixels: FloatArray
    matrix: FloatArray
    model: Range = "near"


def search(
    photo: Image, confirm: Callable[[Face], T | None], *, min_score: float, thorough: bool = False
) -> tuple[list[T], list[str]]:
    """The results of `confirm` for the faces found, largest first, and the names of the views that were tried.

    The search ends after the first group of views with a confirmed face. A weak face in the first group is compared
    with the second group: half a face in a tight crop also looks like a face.

    Args:
        photo: the picture.
        confirm: the result for a face, given in picture pixels; None for a false detection.
        min_score: least confidence of a detection, 0..1.
        thorough: search the tiles in any case, for small faces beside a large one.
    """
    tried: list[str] = []
    found: dict[Face, T] = {}
    for views in _views(photo, thorough):
        tried.append(views[0].name)
        for face in distinct([f for view in views for f in _faces(view, min_score)]):
            confirmed = confirm(face)
            if confirmed is not None:
                found[face] = confirmed
        if found and (len(tried) > 1 or max(f.score for f in found) >= SURE):
            break
    return [found[face] for face in distinct(list(found))], tried


def _faces(view: View, min_score: float) -> list[Face]:
    return [face.transformed(view.matrix) for face in detect(view.pixels, model=view.model, min_score=min_score)]


def _views(photo: Image, thorough: bool) -> Iterator[list[View]]:
    """Groups of views in the order in which they are tried."""
    small, shrink = _shrunk(photo.pixels)
    if not np.isfinite(small).all():
        warn("the photo has values that are not numbers: they count as black in the search for faces")
    small = network_pixels(small, photo.encoding)
    tiles = [*_tiles(small, shrink, 2), *_tiles(small, shrink, 3)]
    whole = [View("as it is", small, shrink), View("as it is", small, shrink, "far")]
    yield whole + tiles if thorough else whole
    padded, pad = _padded(small)
    pad = _after(shrink, pad)
    yield [View("with a border around it", padded, pad), View("with a border around it", padded, pad, "far")]
    if tiles and not thorough:
        yield tiles
    for name, code in _ROTATIONS.items():
        rotated, matrix = _rotated(padded, code)
        yield [View(name, rotated, _after(pad, matrix))]


_ROTATIONS = {
    "turned left": cv2.ROTATE_90_COUNTERCLOCKWISE,
    "turned right": cv2.ROTATE_90_CLOCKWISE,
    "upside down": cv2.ROTATE_180,
}


def _shrunk(pixels: FloatArray) -> tuple[FloatArray, FloatArray]:
    height, width = pixels.shape[:2]
    scale = min(1.0, LONG_SIDE / max(height, width))
    if scale == 1:
        return pixels, np.eye(2, 3, dtype=np.float32)
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    x, y = width / size[0], height / size[1]
    matrix = np.array([[x, 0, x / 2 - 0.5], [0, y, y / 2 - 0.5]], np.float32)
    return np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), dtype=np.float32), matrix


def _padded(pixels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """With a black border of half the longer side, so that a tight crop becomes a picture of a whole head."""
    border = max(pixels.shape[:2]) // 2
    padded = cv2.copyMakeBorder(pixels, border, border, border, border, cv2.BORDER_CONSTANT)
    return np.asarray(padded, dtype=np.float32), np.array([[1, 0, -border], [0, 1, -border]], np.float32)


def _tiles(pixels: FloatArray, matrix: FloatArray, count: int) -> Iterator[View]:
    """`count` x `count` tiles that overlap by half; none where they would be too small to show more than the whole."""
    height, width = pixels.shape[:2]
    side = round(2 * max(height, width) / (count + 1))
    if side < 128:
        return
    for top in _starts(height, side, count):
        for left in _starts(width, side, count):
            tile = pixels[top : top + side, left : left + side]
            shift = np.array([[1, 0, left], [0, 1, top]], np.float32)
            yield View("in overlapping tiles", tile, _after(matrix, shift))


def _starts(length: int, side: int, count: int) -> list[int]:
    return sorted({round(i * max(length - side, 0) / max(count - 1, 1)) for i in range(count)})


def _rotated(pixels: FloatArray, code: int) -> tuple[FloatArray, FloatArray]:
    height, width = pixels.shape[:2]
    matrix = {
        cv2.ROTATE_90_COUNTERCLOCKWISE: [[0, -1, width - 1], [1, 0, 0]],
        cv2.ROTATE_90_CLOCKWISE: [[0, 1, 0], [-1, 0, height - 1]],
        cv2.ROTATE_180: [[-1, 0, width - 1], [0, -1, height - 1]],
    }[code]
    return np.asarray(cv2.rotate(pixels, code), dtype=np.float32), np.array(matrix, np.float32)


def _after(outer: FloatArray, inner: FloatArray) -> FloatArray:
    """The map that applies `inner`, then `outer`."""
    return np.concatenate([outer[:, :2] @ inner[:, :2], (outer[:, :2] @ inner[:, 2] + outer[:, 2])[:, None]], axis=1)


def distinct(faces: list[Face]) -> list[Face]:
    """Each face once, largest first: overlapping tiles show the same face several times."""
    kept: list[Face] = []
    for face in sorted(faces, key=lambda f: -f.score):
        if not any(np.abs(face.center - k.center).max() < 0.5 * max(face.size, k.size) for k in kept):
            kept.append(face)
    return sorted(kept, key=lambda f: -f.size)
