"""Segment photos with and without noise of one 8-bit level: how far the labels jump."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import GraphfaceError, warn
from graphface.nodes.commands.segmentation_truth import Labeller, iou, segment_photo
from graphface.nodes.io.image_read import read_image
from graphface.nodes.landmarks.facemesh import facemesh as find_landmarks
from graphface.nodes.matting.guided import guided
from graphface.nodes.types import Image, Landmarks

LEAST = 0.005
"""Share of the picture below which a label is not judged: a few pixels of background beside a face that fills it."""


@dataclass(frozen=True)
class Shaken:
    """Overlap of each label with itself under noise, the worst of all seeds, in the order face, hair, background.

    `shares`: how much of the picture each label covers. `worst`: the least overlap of a label of at least `LEAST`.
    """

    photo: str
    overlaps: tuple[float, ...]
    shares: tuple[float, ...]

    @property
    def worst(self) -> float:
        return min((o for o, s in zip(self.overlaps, self.shares, strict=True) if s >= LEAST), default=1.0)


def segment_noise(photos: Iterable[Path], seeds: int = 2, label: Labeller = segment_photo) -> Iterator[Shaken]:
    """Segment every photo as graphs/segment.yaml does, as it is and with noise.

    The landmarks are those of the photo without noise: how steady they are is another stage's promise.
    """
    for name, photo, landmarks in portraits(photos):
        yield shaken(name, photo, landmarks, seeds, label)


def portraits(photos: Iterable[Path]) -> Iterator[tuple[str, Image, Landmarks]]:
    """Name, picture and landmarks of each file; what is no picture, or shows no face, is warned about and left out."""
    for path in photos:
        try:
            photo = read_image(path)
            yield path.stem, photo, find_landmarks(photo)
        except GraphfaceError as error:
            warn(f"{path.name} is left out: {error}")


def likeliest(photo: Image, landmarks: Landmarks, label: Labeller) -> NDArray[np.intp]:
    """The label of every pixel after guided matting, H x W: 0 face, 1 hair, 2 background."""
    labels = guided(photo, label(photo, landmarks), landmarks)
    return np.asarray(np.stack([labels.face, labels.hair, labels.background]).argmax(axis=0))


def shaken(name: str, photo: Image, landmarks: Landmarks, seeds: int = 2, label: Labeller = segment_photo) -> Shaken:
    """One photo; noise adds -1, 0 or 1 level of 255 to every channel of every pixel."""
    before = likeliest(photo, landmarks, label)
    overlaps = [1.0, 1.0, 1.0]
    for seed in range(seeds):
        noise = np.random.default_rng(seed).integers(-1, 2, photo.pixels.shape) / 255
        after = likeliest(photo.with_pixels(np.clip(photo.pixels + noise, 0, 1)), landmarks, label)
        overlaps = [min(overlaps[k], iou(before == k, after == k)) for k in range(3)]
    return Shaken(name, tuple(overlaps), tuple(float((before == k).mean()) for k in range(3)))
