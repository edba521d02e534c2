"""What the label network learns from: photographs with a teacher's labels, path-traced heads with the true ones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import GraphfaceError, warn
from graphface.nodes.bench.heads import LIGHTS, heads_of
from graphface.nodes.geometry.facemesh import facemesh as build_mesh
from graphface.nodes.io.image_read import read_image
from graphface.nodes.landmarks.facemesh import facemesh as find_landmarks
from graphface.nodes.masks.geometric import geometric
from graphface.nodes.masks.network import network, window_probabilities
from graphface.nodes.masks.upright_grid import HEIGHT, WIDTH, UprightGrid, upright_grid
from graphface.nodes.network_pixels import network_pixels
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import FloatArray, Image, Landmarks

Bytes = NDArray[np.uint8]

MARGIN, FINE = 4 / 3, 3
"""How much wider a lesson's picture is than the network's grid, and how many times finer that grid."""

CERTAINTY = 2.0
"""The teacher's logits are multiplied by it: what it is nearly sure of is to be learned as sure."""

BACKDROP = 0
"""Of the teacher's six classes."""


@dataclass(frozen=True)
class Lesson:
    """One picture upright, with a margin about it, h x w (x C) as bytes.

    `pixels` sRGB; `seen` 255 within the photo; `labels` face and hair; `person` all that is no backdrop; `plate` the
    backdrop without the person. `landmarks` in this picture's pixels.
    """

    name: str
    pixels: Bytes
    seen: Bytes
    labels: Bytes
    person: Bytes
    plate: Bytes
    landmarks: Landmarks


def photo_lessons(paths: Iterable[Path]) -> Iterator[Lesson]:
    """Photographs with the labels of `masks.network`; those without a face are left out."""
    for path in paths:
        try:
            photo = read_image(path)
            landmarks = find_landmarks(photo)
        except GraphfaceError as error:
            warn(f"{path.name} is left out: {error}")
            continue
        masks = geometric(photo, landmarks, rasterize(build_mesh(landmarks), photo))
        found = network(photo, landmarks, masks, inverse_temperature=CERTAINTY)
        labels = np.stack([found.face, found.hair], axis=2)
        yield lesson(path.stem, photo, landmarks, labels, np.maximum(_person(photo, landmarks), labels.sum(axis=2)))


def head_lessons(data: Path) -> Iterator[Lesson]:
    """The heads of `data`/truth under every light, with their true labels and the landmarks found in each picture."""
    for head in heads_of(data):
        labels = head.labels[..., :2]
        for light in LIGHTS:
            photo = head.photo(light)
            try:
                landmarks = find_landmarks(photo)
            except GraphfaceError as error:
                warn(f"{head.name}/{light}.png is left out: {error}")
                continue
            yield lesson(f"{head.name}_{light}", photo, landmarks, labels, labels.sum(axis=2))


def lesson(name: str, photo: Image, landmarks: Landmarks, labels: FloatArray, person: FloatArray) -> Lesson:
    """Everything about one picture on its lesson's grid."""
    grid = upright_grid(landmarks)
    middle = np.array([WIDTH - 1, HEIGHT - 1]) / 2
    matrix = grid.matrix / MARGIN
    matrix[:, 2] += middle * (1 - 1 / MARGIN)
    wide = UprightGrid(matrix)
    pixels = np.clip(wide.sampled(network_pixels(photo.pixels, photo.encoding), FINE), 0, 1)
    maps = np.clip(wide.sampled(np.dstack([labels, person]), FINE), 0, 1)
    seen = wide.inside(photo.pixels.shape, FINE)
    plate = plate_behind(pixels, maps[..., 2], seen)
    return Lesson(
        name=name,
        pixels=_bytes(pixels),
        seen=_bytes(seen),
        labels=_bytes(maps[..., :2]),
        person=_bytes(maps[..., 2]),
        plate=_bytes(plate),
        landmarks=wide.to_grid(landmarks, FINE),
    )


def _bytes(unit: FloatArray) -> Bytes:
    return np.rint(255 * unit).astype(np.uint8)


def plate_behind(pixels: FloatArray, person: FloatArray, seen: FloatArray) -> FloatArray:
    """The backdrop goes on behind the person: means of what shows, over ever wider surroundings."""
    import cv2

    weight = (np.square(1 - person) * seen)[..., None]
    plate, known = pixels * weight, weight
    for level in range(2, 8):
        size = (max(1, pixels.shape[1] >> level), max(1, pixels.shape[0] >> level))
        joint = cv2.resize(np.dstack([pixels * weight, weight]), size, interpolation=cv2.INTER_AREA)
        joint = cv2.resize(cv2.GaussianBlur(joint, (0, 0), 1.0), pixels.shape[1::-1], interpolation=cv2.INTER_CUBIC)
        mean = joint[..., :3] / np.maximum(joint[..., 3:], 1e-3)
        share = (1 - known) * np.clip(8 * joint[..., 3:], 0, 1)
        plate, known = plate + share * mean, known + share
    return np.asarray(np.clip(plate + (1 - known) * 0.5, 0, 1), np.float32)


def _person(photo: Image, landmarks: Landmarks) -> FloatArray:
    """What the teacher does not call backdrop, H x W: clothes and hands too."""
    import cv2

    window, chances = window_probabilities(photo, landmarks)
    person = np.zeros(photo.pixels.shape[:2], np.float32)
    size = (window.right - window.left, window.bottom - window.top)
    person[window.part] = 1 - cv2.resize(np.ascontiguousarray(chances[..., BACKDROP]), size)
    return person
