"""Soft edges by the most similar pixels."""

from __future__ import annotations

import numpy as np
from portraits import landmarks_at

from graphface.nodes.matting.knn import knn
from graphface.nodes.types import Image, Segmentation


class TestKnn:
    def test_alphas_follow_color_across_a_gap(self):
        """An unknown speck of the face's color is face, though background lies between."""
        pixels = np.zeros((40, 40, 3), np.float32)
        pixels[:, 20:] = 0.8
        pixels[18:21, 16:18] = 0.8
        face = np.zeros((40, 40), np.float32)
        face[:, 20:] = 1
        labels = Segmentation(face, np.zeros_like(face), 1 - face)
        found = knn(Image(pixels), labels, landmarks_at(20, 20, 40), width=0.2)
        assert found.face[19, 16] > 0.8
        assert found.face[5, 16] < 0.2
