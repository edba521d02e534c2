"""A training picture of a drawn head."""

from __future__ import annotations

import numpy as np
from portraits import portrait

from graphface.nodes.learning.label_paint import Person
from graphface.nodes.learning.label_pictures import training_picture
from graphface.nodes.masks.upright_grid import upright_grid


def drawn_picture():
    """A drawn head whose labels are known."""
    photo, landmarks, labels = portrait()
    masks = np.stack([labels == 0, labels == 1], axis=2).astype(np.float32)
    return training_picture("drawn", photo, landmarks, masks, masks.sum(axis=2))


PICTURE = drawn_picture()


def drawn_person():
    """The same head on the network's grid."""
    grid = upright_grid(PICTURE.landmarks)
    maps = (grid.sampled(part) / np.float32(255) for part in (PICTURE.pixels, PICTURE.labels, PICTURE.person))
    return Person(*maps, grid.to_grid(PICTURE.landmarks))
