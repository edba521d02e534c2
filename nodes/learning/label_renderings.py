"""Training pictures of the label network from rendered heads, whose labels are known: bald ones, too."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from graphface import GraphfaceError, UnreadableFile
from graphface.nodes.face_outlines import LIPS
from graphface.nodes.landmarks.facemesh import facemesh as find_landmarks
from graphface.nodes.learning.label_pictures import TrainingPicture, training_picture
from graphface.nodes.learning.rendering.example import REST, Example, read_example
from graphface.nodes.types import FloatArray, Image, Landmarks


def rendered_pictures(folder: Path, count: int) -> Iterator[TrainingPicture]:
    """At most `count` examples of `graphface models render`, evenly over the folder; those without a face left out.

    Raises:
        UnreadableFile: there are no examples.
    """
    paths = sorted(folder.glob("*.npz"))
    if not paths:
        raise UnreadableFile(folder, "holds no examples; `graphface models render` makes them")
    for place in np.unique(np.linspace(0, len(paths) - 1, min(count, len(paths))).round().astype(int)):
        try:
            yield rendered_picture(read_example(paths[place]), f"rendered_{paths[place].stem}")
        except GraphfaceError:
            continue  # few, turned away or in the dark: as in `normal_lessons`, nothing is learned from them


def rendered_picture(example: Example, name: str) -> TrainingPicture:
    """The training picture of an example.

    Raises:
        GraphfaceError: no face is found.
    """
    photo = Image(example.photo.astype(np.float32) / np.float32(255))
    landmarks = find_landmarks(photo)
    labels = labels_of(example, landmarks)
    return training_picture(name, photo, landmarks, labels, np.asarray(example.depth != 0, np.float32))


def labels_of(example: Example, landmarks: Landmarks) -> FloatArray:
    """Face (with eyes, teeth and mouth) and hair of an example, H x W x 2: what is left of the head is hair."""
    import cv2

    mouth = np.zeros(example.labels.shape, np.uint8)
    cv2.fillPoly(mouth, [np.rint(landmarks.points[list(LIPS), :2]).astype(np.int32)], 1)
    head = example.depth != 0
    face = head & ((example.labels != REST) | (mouth > 0))
    return np.stack([face, head & ~face], axis=2).astype(np.float32)
