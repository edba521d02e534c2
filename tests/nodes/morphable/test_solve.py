"""Levenberg and Marquardt on the cost of a fit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from faces import coefficients_of, landmarks_of, rotation_of

from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.fit_problem import Settings, fit_of_photo, reduced_model
from graphface.nodes.morphable.solve import POSE, View, _normal_equations, _stepped, solve, view_cost

REDUCED = reduced_model(builtin_model(), 4, 2, "mixture")


def problem_of(camera="weak", seed=1):
    landmarks = landmarks_of(coefficients=coefficients_of(seed), rotation=rotation_of(15, 5), near=0.1)
    return fit_of_photo(REDUCED, landmarks, Settings(camera), None).problem


def view_of(problem, seed=0):
    rng = np.random.default_rng(seed)
    x = rng.normal(scale=0.3, size=len(problem.directions))
    return View(rotation_of(10), 140.0, np.array([3.0, -2.0]), problem.nearness[0], x)


class TestNormalEquations:
    @pytest.mark.parametrize("camera", ["weak", "estimated"])
    def test_gradient_is_the_derivative(self, camera):
        """Central differences of the cost agree with the gradient, for every parameter of the pose and the model."""
        problem = problem_of(camera)
        view = view_of(problem)
        _, gradient = _normal_equations(problem, view)
        for k in range(POSE + len(view.x)):
            step = np.zeros(POSE + len(view.x))
            step[k] = 1e-5
            difference = view_cost(problem, _stepped(problem, view, step)) - view_cost(
                problem, _stepped(problem, view, -step)
            )
            assert gradient[k] == pytest.approx(difference / 2e-5, rel=1e-3, abs=1e-3 * np.abs(gradient).max())


class TestSolve:
    def test_costs_decrease(self):
        """No accepted step raises the cost, and the search converges."""
        problem = problem_of()
        found = solve([problem], [view_of(problem)], steps=50, tolerance=1e-6)
        assert (np.diff(found.costs) <= 0).all()
        assert found.converged
        assert found.condition > 1

    def test_shared_coefficients(self):
        """The first coefficients are the same in all views, the others are not."""
        problems = [problem_of(seed=k) for k in (1, 2)]
        start = [replace(view_of(p), x=np.zeros(6)) for p in problems]
        one, other = solve(problems, start, steps=30, tolerance=1e-6, shared=4).views
        np.testing.assert_allclose(one.x[:4], other.x[:4])
        assert not np.allclose(one.x[4:], other.x[4:])

    def test_updates_in_the_first_half(self):
        """Correspondences are updated after accepted steps of the first half only."""
        calls = []

        def update(problem, view):
            calls.append(view)
            return problem

        problem = problem_of()
        solve([problem], [view_of(problem)], steps=6, tolerance=1e-12, updates=[update])
        assert 0 < len(calls) <= 3
