"""The solution of a fit as a mesh."""

from __future__ import annotations

import numpy as np
import pytest
from faces import coefficients_of, landmarks_of, rotation_of

from graphface import GraphfaceWarning
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.fit_problem import Settings, fit_of_photo, reduced_model
from graphface.nodes.morphable.fitted_mesh import fitted_mesh
from graphface.nodes.morphable.solve import Solution, View

REDUCED = reduced_model(builtin_model(), None, None, "mixture")


def solution_of(photo, coefficients, rotation, shift=0.0, converged=True):
    offset = np.array([320.0 - photo.center[0] + shift, photo.center[1] - 240.0])
    view = View(rotation, 150.0, offset, 0.0, coefficients)
    return Solution((view,), (photo.problem,), (1.0, 0.5), 10.0, converged)


class TestFittedMesh:
    def test_projects_onto_the_landmarks(self):
        """The true view of a known face has no residual, and its mesh projects onto the landmarks."""
        coefficients, rotation = coefficients_of(1), rotation_of(20)
        landmarks = landmarks_of(coefficients=coefficients, rotation=rotation)
        photo = fit_of_photo(REDUCED, landmarks, Settings(), None)
        mesh = fitted_mesh(REDUCED, photo, solution_of(photo, coefficients, rotation), 0)
        np.testing.assert_allclose(mesh.camera.project(mesh.vertices[:468]), landmarks.points[:, :2], atol=0.01)
        assert mesh.fit.residual < 0.01
        np.testing.assert_allclose(mesh.fit.identity, coefficients[:15], rtol=1e-5)
        assert mesh.interocular == pytest.approx(150, rel=0.2)

    def test_a_poor_fit(self):
        """A view far from the points, and a search that did not converge, are warnings."""
        photo = fit_of_photo(REDUCED, landmarks_of(), Settings(), None)
        with pytest.warns(GraphfaceWarning) as warned:
            fitted_mesh(REDUCED, photo, solution_of(photo, np.zeros(25), np.eye(3), shift=90, converged=False), 0)
        words = [str(one.message) for one in warned]
        assert any("does not fit them" in text for text in words)
        assert any("did not converge in 1 steps" in text for text in words)
