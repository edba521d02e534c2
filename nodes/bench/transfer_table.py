"""A table like the paper's: a row for each input, a column for each reference."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from graphface import Evaluator, GraphfaceError, MemoryTier, load, warn
from graphface.evaluate.mapping import run_over
from graphface.nodes.bench.contact_sheet import Picture
from graphface.nodes.pictures.photo import bytes_of
from graphface.nodes.types import Image, Landmarks

_ASKED = ("image", "pair.landmarks", "pair.working", "pair.reference_landmarks", "pair.reference_working")


def transfer_table(
    photos: Sequence[Path], references: Sequence[Path], *, graph: str = "makeup", side: int = 360, threads: int = 2
) -> Picture:
    """uint8 RGB: the references along the top, the photos down the left, results between them, all `side` pixels.

    A pair that fails leaves its cell dark, with a warning.

    Raises:
        GraphfaceError: the graph cannot be loaded.
    """
    loaded = load(graph)
    evaluator = Evaluator(memory=MemoryTier(), threads=threads)
    table = np.full(((len(photos) + 1) * side, (len(references) + 1) * side, 3), 24, np.uint8)

    def put(row: int, column: int, image: Image, landmarks: Landmarks) -> None:
        cell = table[row * side : (row + 1) * side, column * side : (column + 1) * side]
        cell[:] = face_crop(image, landmarks, side)

    maps = {"photo": [str(p) for p in photos], "reference": [str(r) for r in references]}
    for index, made in enumerate(run_over(loaded, evaluator, maps, {}, loaded.targets(_ASKED))):
        row, column = divmod(index, len(references))
        if made.result is None:
            warn(f"{made.inputs['photo']} under {made.inputs['reference']}: {_reason(made.error)}")
            continue
        found: Any = made.result
        put(row + 1, 0, found["pair.working"], found["pair.landmarks"])
        put(0, column + 1, found["pair.reference_working"], found["pair.reference_landmarks"])
        put(row + 1, column + 1, found["image"], found["pair.landmarks"])
    return table


def face_crop(image: Image, landmarks: Landmarks, side: int) -> Picture:
    """The face and what is around it, square."""
    import cv2

    points = landmarks.points[:, :2]
    low, high = points.min(axis=0), points.max(axis=0)
    scale = side / max(1.5 * float((high - low).max()), 1.0)
    offset = side / 2 - scale * (low + high) / 2
    matrix = np.array([[scale, 0, offset[0]], [0, scale, offset[1]]], np.float32)
    interpolation = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
    cropped = cv2.warpAffine(bytes_of(image), matrix, (side, side), flags=interpolation, borderValue=(24, 24, 24))
    return np.asarray(cropped, np.uint8)


def _reason(error: GraphfaceError | None) -> str:
    return str(error).partition("\n")[0]
