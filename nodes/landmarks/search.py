"""Finding faces that one look at the picture misses.

BlazeFace was made for a phone's camera: it wants some air around a face, misses faces below about a twelfth of the
picture, and knows only heads that are roughly upright. Each rung of the ladder below undoes one of these; the first
rung with a face that stands up to `confirm` ends the search.
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
"""Searching is done on a copy no larger than this; the networks see 256 pixels, or tiles of it."""


SURE = 0.75
"""Detector score from which the first rung is believed alone. Measured: whole faces 0.74 and more, parts of a face up
to 0.64."""


T = TypeVar("T")


@dataclass(frozen=True)
class View:
    """One way of looking at the picture: `matrix` (2, 3) takes the view's pixels back to the picture's."""

    name: str
    pixels: FloatArray
    matrix: FloatArray
    model: Range = "near"


def search(
    photo: Image, confirm: Callable[[Face], T | None], *, min_score: float, thorough: bool = False
) -> tuple[list[T], list[str]]:
    """What `confirm` makes of the faces found, largest first, and the names of the views it took.

    The ladder ends at the first rung after which a face is confirmed, except that a weak one on the first rung (half
    a face in a tight crop also looks like a face) has to hold its own against the second.

    Args:
        photo: the picture.
        confirm: given a face in picture pixels, what stands of it, or None for a false detection.
        min_score: of the detector, 0..1.
        thorough: look into the tiles in any case, for small faces beside a large one.
    """
    tried: list[str] = []
    found: dict[Face, T] = {}
    for views in _ladder(photo, thorough):
        tried.append(views[0].name)
        for face in distinct([f for view in views for f in _faces(view, min_score)]):
            confirmed = confirm(face)
            if confirmed is not None:
                found[face] = confirmed
        if found and (len(tried) > 1 or max(f.score for f in found) >= SURE):
            break
    return [found[face] for face in distinct(list(found))], tried


def _faces(view: View, min_score: float) -> list[Face]:
    return [face.moved(view.matrix) for face in detect(view.pixels, model=view.model, min_score=min_score)]


def _ladder(photo: Image, thorough: bool) -> Iterator[list[View]]:
    small, shrink = _shrunk(photo.pixels)
    if not np.isfinite(small).all():
        warn("the photo has values that are not numbers: taken as black to find the face")
    small = network_pixels(small, photo.encoding)
    tiles = [*_tiles(small, shrink, 2), *_tiles(small, shrink, 3)]
    whole = [View("as it is", small, shrink), View("as it is", small, shrink, "far")]
    yield whole + tiles if thorough else whole
    padded, pad = _padded(small)
    pad = _after(shrink, pad)
    yield [View("with a border around it", padded, pad), View("with a border around it", padded, pad, "far")]
    if tiles and not thorough:
        yield tiles
    for name, turn in _TURNS.items():
        turned, matrix = _turned(padded, turn)
        yield [View(name, turned, _after(pad, matrix))]


_TURNS = {
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
    """A border of half the longer side, in black: the frame of a tight crop looks like a photograph of a head."""
    border = max(pixels.shape[:2]) // 2
    padded = cv2.copyMakeBorder(pixels, border, border, border, border, cv2.BORDER_CONSTANT)
    return np.asarray(padded, dtype=np.float32), np.array([[1, 0, -border], [0, 1, -border]], np.float32)


def _tiles(pixels: FloatArray, matrix: FloatArray, count: int) -> Iterator[View]:
    """`count` x `count` tiles that overlap by half, where they still have detail that the whole view lost."""
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


def _turned(pixels: FloatArray, turn: int) -> tuple[FloatArray, FloatArray]:
    height, width = pixels.shape[:2]
    matrix = {
        cv2.ROTATE_90_COUNTERCLOCKWISE: [[0, -1, width - 1], [1, 0, 0]],
        cv2.ROTATE_90_CLOCKWISE: [[0, 1, 0], [-1, 0, height - 1]],
        cv2.ROTATE_180: [[-1, 0, width - 1], [0, -1, height - 1]],
    }[turn]
    return np.asarray(cv2.rotate(pixels, turn), dtype=np.float32), np.array(matrix, np.float32)


def _after(outer: FloatArray, inner: FloatArray) -> FloatArray:
    """The map that applies `inner`, then `outer`."""
    return np.concatenate([outer[:, :2] @ inner[:, :2], (outer[:, :2] @ inner[:, 2] + outer[:, 2])[:, None]], axis=1)


def distinct(faces: list[Face]) -> list[Face]:
    """Largest first, each face once: tiles overlap, so the same face comes several times."""
    kept: list[Face] = []
    for face in sorted(faces, key=lambda f: -f.score):
        center = (face.box[:2] + face.box[2:]) / 2
        if not any(np.abs(center - (k.box[:2] + k.box[2:]) / 2).max() < 0.5 * max(face.size, k.size) for k in kept):
            kept.append(face)
    return sorted(kept, key=lambda f: -f.size)
