"""The two-level preconditioner."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csr_matrix, diags, identity

from graphface.nodes.matting.two_level import TwoLevel


@pytest.fixture
def system():
    """The Laplacian of a path of 50 pixels, with a small ridge."""
    off = -np.ones(49)
    return (diags([off, 2 * np.ones(50), off], [-1, 0, 1]) + 1e-3 * identity(50)).tocsr()


class TestTwoLevel:
    def test_symmetric_sweep(self, system):
        """Without a coarse space it is the inverse of (D + L) D^-1 (D + U)."""
        full = system.toarray()
        upper, diagonal = np.triu(full), np.diag(np.diag(full))
        residual = np.linspace(-1, 1, 50)
        expected = np.linalg.solve(upper.T @ np.linalg.inv(diagonal) @ upper, residual)
        np.testing.assert_allclose(TwoLevel(system)(residual), expected, rtol=1e-8)

    def test_exact_in_the_coarse_space(self, system):
        """The error of what it returns has no part that the coarse functions can see: Z^T (r - A z) = 0."""
        coarse = csr_matrix(np.kron(np.eye(5), np.ones((10, 1))))
        inverse = TwoLevel(system, coarse)
        residual = np.cos(np.arange(50.0))
        found = inverse(residual)
        rest = coarse.T @ (residual - system @ found)
        assert np.abs(rest).max() < 1e-6 * np.abs(coarse.T @ residual).max() + 1e-8
        start, image = inverse.start(residual)
        np.testing.assert_allclose(image, system @ start, atol=1e-9)
