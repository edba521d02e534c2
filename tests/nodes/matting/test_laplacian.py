"""The system of the band against the Laplacian of the whole picture."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from pymatting.laplacian.cf_laplacian import cf_laplacian

from graphface.nodes.matting.laplacian import band_system


@pytest.fixture
def case(rng):
    unknown = rng.uniform(size=(40, 30)) < 0.4
    unknown[:3] = unknown[-3:] = unknown[:, :3] = unknown[:, -3:] = False
    return rng.uniform(size=(40, 30, 3)), unknown, rng.uniform(size=(40, 30, 2)).astype(np.float32)


class TestBandSystem:
    @pytest.mark.parametrize("strip", [1, 2**16])
    def test_is_a_part_of_the_whole(self, case, strip, monkeypatch):
        """Rows and columns of unknown pixels, and known alphas on the right-hand side, for any height of the strips."""
        monkeypatch.setattr(sys.modules[band_system.__module__], "STRIP", strip)
        colors, unknown, known = case
        count = int(unknown.sum())
        system, right = band_system(colors, unknown, known, np.ones((count, 2)), ridge=1e-7, label_weight=0.5)
        whole = cf_laplacian(colors, 1e-7).toarray()
        inside = unknown.reshape(-1)
        np.testing.assert_allclose(system.toarray(), whole[inside][:, inside] + 0.5 * np.eye(count), atol=1e-9)
        from_known = whole[inside][:, ~inside] @ known.reshape(-1, 2)[~inside]
        np.testing.assert_allclose(right, 0.5 - from_known, atol=1e-6)

    def test_is_symmetric(self, case):
        """The matrix is symmetric."""
        colors, unknown, known = case
        system, _ = band_system(colors, unknown, known, np.zeros((int(unknown.sum()), 2)), ridge=1e-7, label_weight=0)
        assert abs(system - system.T).max() < 1e-9

    def test_without_a_window(self):
        """In a picture too small for a window the solution is the guess."""
        guess = np.full((6, 2), 0.25)
        system, right = band_system(
            np.zeros((2, 3, 3)), np.ones((2, 3), bool), np.zeros((2, 3, 2)), guess, ridge=1e-7, label_weight=1e-3
        )
        np.testing.assert_allclose(np.linalg.solve(system.toarray(), right), guess)
