"""The skin by which the photo's light is estimated."""

from __future__ import annotations

import numpy as np

from graphface.nodes.harmonics import ambient, basis
from graphface.nodes.sh.fit import fit
from graphface.nodes.sh.skin_weights import skin_weights
from graphface.nodes.types import Segmentation

FACE, HEAD, SKIN = (np.float32([values]) for values in ([1, 0.5, 0, 0, 0], [1, 1, 1, 1, 0], [1, 1, 1, 0, 1]))
LABELS = Segmentation(SKIN, 0 * SKIN, 1 - SKIN)


class TestSkinWeights:
    def test_face_counts_most(self):
        """Skin beyond it counts less, and only on the head; hair and shoulders do not."""
        np.testing.assert_allclose(skin_weights(FACE, HEAD, LABELS), np.float32([[1, 0.5, 0.2, 0, 0]]))

    def test_nothing_beyond(self):
        """With 0 the weights are the face mask; the arguments stay as they were."""
        np.testing.assert_array_equal(skin_weights(FACE, HEAD, LABELS, beyond=0), FACE)
        np.testing.assert_array_equal(SKIN, np.float32([[1, 1, 1, 0, 1]]))

    def test_even_light_on_stubble(self):
        """A dark jaw within the face looks like light from above, until the neck is seen as well."""
        random = np.random.default_rng(0)
        normals = random.normal(size=(60, 60, 3)).astype(np.float32)
        normals[..., 2] = np.abs(normals[..., 2]) + 0.5
        normals[:30, :, 1], normals[30:, :, 1] = np.abs(normals[:30, :, 1]), -np.abs(normals[30:, :, 1])
        normals /= np.linalg.norm(normals, axis=2, keepdims=True)
        light = ambient(np.float32(0.5), 1)
        shading = (basis(normals.reshape(-1, 3), 1) @ light.coefficients).reshape(60, 60)
        shading[30:40] *= 0.7
        face = np.zeros((60, 60), np.float32)
        face[:40] = 1
        labels = Segmentation(np.ones_like(face), 0 * face, 0 * face)
        slopes = []
        for beyond in (0.0, 0.2):
            weights = skin_weights(face, np.ones_like(face), labels, beyond=beyond)
            slopes.append(float(fit(shading.astype(np.float32), normals, weights, robust="none").light.coefficients[1]))
        assert 0 < slopes[1] < 0.85 * slopes[0]
