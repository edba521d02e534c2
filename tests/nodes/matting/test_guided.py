"""Soft edges by the guided filter."""

from __future__ import annotations

import numpy as np
from portraits import landmarks_at, portrait

from graphface.nodes.matting.guided import guided
from graphface.nodes.types import Image, Segmentation


def edge(side=60):
    """A picture with a vertical edge, and hard labels of face and background along it."""
    pixels = np.zeros((side, side, 3), np.float32)
    pixels[:, side // 2 :] = (0.9, 0.7, 0.5)
    face = np.zeros((side, side), np.float32)
    face[:, side // 2 :] = 1
    return Image(pixels), Segmentation(face, np.zeros_like(face), 1 - face)


class TestGuided:
    def test_keeps_a_sharp_edge(self):
        """Labels that end at an edge of the photo stay sharp."""
        photo, labels = edge()
        found = guided(photo, labels, landmarks_at(30, 30, 60))
        assert np.abs(found.face - labels.face).max() < 0.05

    def test_ridge_smooths(self):
        """With a ridge far above the photo's variance the labels become box means."""
        photo, labels = edge()
        found = guided(photo, labels, landmarks_at(30, 30, 60), ridge=1.0)
        assert 0.2 < found.face[30, 28] < 0.8

    def test_resolution_of_the_small_copy_matters_little(self):
        """Half the resolution gives nearly the same alphas."""
        photo, landmarks, numbers = portrait(200)
        labels = Segmentation(*(np.float32(numbers == k) for k in range(3)))
        full, half = (guided(photo, labels, landmarks, resolution=r) for r in (44, 22))
        assert np.abs(full.hair - half.hair).mean() < 0.01
