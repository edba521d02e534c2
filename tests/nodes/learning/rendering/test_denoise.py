"""Noise removed by what is known."""

from __future__ import annotations

import numpy as np

from graphface.nodes.learning.rendering.denoise import denoised


class TestDenoised:
    def test_noise_goes_edges_stay(self, rng):
        """Noise falls to a quarter; edges of albedo and of shadow stay sharp."""
        y, x = np.mgrid[-1:1:96j, -1:1:96j]
        normals = np.dstack([x, -y, np.ones_like(x) * 2]).astype(np.float32)
        normals /= np.linalg.norm(normals, axis=2, keepdims=True)
        albedo = np.where(x[..., None] > 0.3, 0.1, 0.6) * np.ones(3, np.float32)
        lit = (y > 0.2).astype(np.float32)
        clean = (albedo + 0.06) * (0.2 + 0.8 * lit * normals[..., 2])[..., None]
        noisy = clean * (1 + 0.3 * rng.normal(size=clean.shape))
        found = denoised(
            noisy.astype(np.float32),
            albedo.astype(np.float32),
            normals,
            (255 * lit).astype(np.uint8),
            np.ones(lit.shape, bool),
        )
        inside = (slice(3, -3), slice(3, -3))
        assert np.abs(found - clean)[inside].mean() < 0.3 * np.abs(noisy - clean)[inside].mean()

    def test_background_and_fireflies(self):
        """Beyond the head the picture is blurred; a single bright path is cut."""
        radiance = np.full((32, 32, 3), 0.2, np.float32)
        radiance[10, 10] = 1e4
        zeros, ones = np.zeros((32, 32, 3), np.float32), np.ones((32, 32), bool)
        found = denoised(radiance, zeros, zeros, np.zeros((32, 32), np.uint8), ones)
        assert found.max() < 1
        assert np.isfinite(denoised(radiance, zeros, zeros, np.zeros((32, 32), np.uint8), ~ones)).all()
