"""Training pictures of the label network: photographs with a teacher's labels, path-traced heads with the true ones."""

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
"""Size of a training picture over that of the network's grid, and the supersampling of the grid."""

INVERSE_TEMPERATURE = 2.0
"""Factor on the teacher's logits: labels that are nearly certain are learned as certain."""

BACKDROP = 0
"""Its number among the teacher's six classes."""


@dataclass(frozen=True)
class TrainingPicture:
    """A picture of an upright head, with a margin around the network's grid, h x w (x C) as bytes.

    `pixels` sRGB; `inside` 255 within the photo; `labels` face and hair; `person` everything but backdrop; `plate` the
    backdrop without the person. `landmarks` in this picture's pixels.
    """

    name: str
    pixels: Bytes
    inside: Bytes
    labels: Bytes
    person: Bytes
    plate: Bytes
    landmarks: Landmarks


def photo_pictures(paths: Iterable[Path]) -> Iterator[TrainingPicture]:
    """Photographs with the labels of `masks.network`; those without a face are left out."""
    for path in paths:
        try:
            photo = read_image(path)
            landmarks = find_landmarks(photo)
        except GraphfaceError as error:
            warn(f"{path.name} is left out: {error}")
            continue
        masks = geometric(photo, landmarks, rasterize(build_mesh(landmarks), photo))
        found = network(photo, landmarks, masks, inverse_temperature=INVERSE_TEMPERATURE)
        labels = np.stack([found.face, found.hair], axis=2)
        yield training_picture(
            path.stem, photo, landmarks, labels, np.maximum(_person(photo, landmarks), labels.sum(axis=2))
        )


def head_pictures(data: Path) -> Iterator[TrainingPicture]:
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
            yield training_picture(f"{head.name}_{light}", photo, landmarks, labels, labels.sum(axis=2))


def training_picture(
    name: str, photo: Image, landmarks: Landmarks, labels: FloatArray, person: FloatArray
) -> TrainingPicture:
    """A photo warped onto the grid of training pictures; `labels` H x W x 2 and `person` H x W in [0, 1]."""
    grid = upright_grid(landmarks)
    middle = np.array([WIDTH - 1, HEIGHT - 1]) / 2
    matrix = grid.matrix / MARGIN
    matrix[:, 2] += middle * (1 - 1 / MARGIN)
    wide = UprightGrid(matrix)
    pixels = np.clip(wide.sampled(network_pixels(photo.pixels, photo.encoding), FINE), 0, 1)
    maps = np.clip(wide.sampled(np.dstack([labels, person]), FINE), 0, 1)
    inside = wide.inside(photo.pixels.shape, FINE)
    plate = plate_behind(pixels, maps[..., 2], inside)
    return TrainingPicture(
        name=name,
        pixels=_bytes(pixels),
        inside=_bytes(inside),
        labels=_bytes(maps[..., :2]),
        person=_bytes(maps[..., 2]),
        plate=_bytes(plate),
        landmarks=wide.to_grid(landmarks, FINE),
    )


def _bytes(unit: FloatArray) -> Bytes:
    return np.rint(255 * unit).astype(np.uint8)


def plate_behind(pixels: FloatArray, person: FloatArray, inside: FloatArray) -> FloatArray:
    """The backdrop, filled in behind the person by means over wider and wider neighborhoods."""
    import cv2

    weight = (np.square(1 - person) * inside)[..., None]
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
    """1 minus the teacher's probability of backdrop, H x W: clothes and hands are part of the person."""
    import cv2

    window, probabilities = window_probabilities(photo, landmarks)
    person = np.zeros(photo.pixels.shape[:2], np.float32)
    size = (window.right - window.left, window.bottom - window.top)
    person[window.part] = 1 - cv2.resize(np.ascontiguousarray(probabilities[..., BACKDROP]), size)
    return person
