"""Alphas by conjugate gradients: the right solution, few steps, and a fallback."""

from __future__ import annotations

import sys
import warnings

import numpy as np
import pytest
import scipy.sparse.linalg
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_matrix, identity

from graphface import GraphfaceWarning
from graphface.nodes.matting.coarse import color_lines
from graphface.nodes.matting.laplacian import band_system
from graphface.nodes.matting.solve import solve_alphas


def band(rng, side=48, scale=1.0):
    """Smooth colors with noise, everything unknown but the frame, half of which is face."""
    y, x = np.mgrid[:side, :side] / side
    colors = np.stack([y, x, y * x], axis=2) + rng.normal(0, 0.02, (side, side, 3))
    unknown = np.zeros((side, side), bool)
    unknown[2:-2, 2:-2] = True
    known = np.stack([x < 0.5, x >= 0.5], axis=2).astype(np.float32)
    guess = rng.uniform(size=(int(unknown.sum()), 2)).astype(np.float32)
    return scale * colors, unknown, known, guess


class TestSolveAlphas:
    @settings(max_examples=20, deadline=None)
    @given(
        seed=st.integers(0, 2**16),
        scale=st.sampled_from([0.0, 1e-4, 1.0]),
        label_weight=st.sampled_from([1e-6, 1e-4, 1]),
    )
    def test_solves(self, seed, scale, label_weight):
        """With coarse functions or without, for any colors, it is the solution, without a warning."""
        colors, unknown, known, guess = band(np.random.default_rng(seed), side=20, scale=scale)
        system, right = band_system(colors, unknown, known, guess, ridge=1e-7, label_weight=label_weight)
        exact = np.linalg.solve(system.toarray(), right)
        for coarse in (None, color_lines(colors, unknown)):
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                found = solve_alphas(system, right, guess, tolerance=1e-9, coarse=coarse)
            np.testing.assert_allclose(found, exact, atol=1e-4)

    def test_coarse_functions_save_steps(self, rng, monkeypatch):
        """Eight steps with them come nearer to the solution than forty without."""
        module = sys.modules[solve_alphas.__module__]
        colors, unknown, known, guess = band(rng)
        system, right = band_system(colors, unknown, known, guess, ridge=1e-7, label_weight=1e-6)
        exact = scipy.sparse.linalg.spsolve(system.tocsc(), right)
        errors = {}
        for steps, coarse in ((8, color_lines(colors, unknown)), (40, None)):
            monkeypatch.setattr(module, "STEPS", steps)
            with pytest.warns(GraphfaceWarning, match="did not reach"):
                found = solve_alphas(system, right, guess, tolerance=1e-12, coarse=coarse)
            errors[steps] = np.abs(found - exact).mean()
        assert errors[8] < errors[40]

    def test_no_factors_is_a_warning(self, rng, monkeypatch):
        """Where the small system cannot be factored the solve goes on without it, with a warning."""

        def fail(*_args, **_options):
            raise RuntimeError("Factor is exactly singular")

        monkeypatch.setattr(scipy.sparse.linalg, "splu", fail)
        colors, unknown, known, guess = band(rng, side=16)
        system, right = band_system(colors, unknown, known, guess, ridge=1e-7, label_weight=1e-4)
        with pytest.warns(GraphfaceWarning, match="cannot be factored"):
            found = solve_alphas(system, right, guess, tolerance=1e-9, coarse=color_lines(colors, unknown))
        np.testing.assert_allclose(found, np.linalg.solve(system.toarray(), right), atol=1e-4)

    def test_not_finite_keeps_the_guess(self):
        """A system that is not finite leaves the labels unchanged, with a warning."""
        guess = np.full((3, 2), 0.25, np.float32)
        with pytest.warns(GraphfaceWarning, match="did not reach"):
            found = solve_alphas(csr_matrix(np.diag([1, np.nan, 1])), np.ones((3, 2)), guess, tolerance=1e-3)
        np.testing.assert_array_equal(found, guess)

    def test_label_weight_alone_keeps_the_guess(self):
        """A system without a Laplacian leaves the labels unchanged."""
        guess = np.float32([[0.25, 0.5], [0.0, 1.0]])
        system = (1e-3 * identity(2)).tocsr()
        found = solve_alphas(system, 1e-3 * guess.astype(float), guess, tolerance=1e-4)
        np.testing.assert_allclose(found, guess, atol=1e-6)
