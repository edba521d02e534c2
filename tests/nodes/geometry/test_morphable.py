"""A face model fitted to landmarks: known faces are recovered, and every parameter has its effect."""

from __future__ import annotations

import numpy as np
import pytest
from faces import coefficients_of, grid_model, landmarks_of, rotation_of

from graphface import GraphfaceWarning, UsageError
from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.landmark_schemes import UnusableLandmarks
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.pose import yaw_pitch_roll
from graphface.nodes.types import Landmarks


def shape_error(mesh, coefficients, rotation, scale=150.0):
    """Root mean square distance between a fitted and a true face, in eye distances; the position does not count."""
    truth = builtin_model().vertices(coefficients) @ rotation.T
    found = mesh.vertices / scale
    difference = (found - found.mean(axis=0)) - (truth - truth.mean(axis=0))
    return np.sqrt(np.square(difference).sum(axis=1).mean())


class TestMorphable:
    @pytest.mark.parametrize("yaw", [-45, -20, 0, 30, 45])
    def test_recovers_a_known_face(self, yaw):
        """Exact landmarks of a known face at up to 45 degrees give back its shape and pose."""
        coefficients, rotation = coefficients_of(1), rotation_of(yaw, 8, -5)
        mesh = morphable(landmarks_of(coefficients=coefficients, rotation=rotation), noise=0.005, strength=0.1)
        assert shape_error(mesh, coefficients, rotation) < 0.02
        assert yaw_pitch_roll(mesh.fit.rotation)[0] == pytest.approx(yaw, abs=1.5)

    def test_projects_onto_the_landmarks(self):
        """The camera takes the landmark vertices to their landmarks; errors and residual say how near."""
        landmarks = landmarks_of(coefficients=coefficients_of(2))
        mesh = morphable(landmarks, noise=0.01)
        projected = mesh.camera.project(mesh.vertices[builtin_model().landmarks["facemesh468"]])
        apart = np.linalg.norm(projected - landmarks.points[:, :2], axis=1)
        np.testing.assert_allclose(apart, mesh.fit.errors, atol=1e-2)
        assert mesh.fit.residual < 0.01 * 150

    def test_records_its_convergence(self):
        """Costs fall, the search comes to rest, and the condition is a number."""
        fit = morphable(landmarks_of(coefficients=coefficients_of(3), rotation=rotation_of(15))).fit
        assert (np.diff(fit.costs) <= 1e-4 * np.abs(fit.costs[:-1])).all()
        assert fit.converged
        assert 1 <= fit.condition < 1e6

    def test_full_perspective_is_recovered(self):
        """Landmarks seen from 6 eye distances are explained by a camera at about 6."""
        landmarks = landmarks_of(coefficients=coefficients_of(4, 0.3), near=1 / 6, rotation=rotation_of(20))
        estimated = morphable(landmarks, camera="estimated", noise=0.003, strength=0.3)
        weak = morphable(landmarks, camera="weak", noise=0.003, strength=0.3)
        assert estimated.fit.distance == pytest.approx(6, rel=0.25)
        assert estimated.fit.residual < weak.fit.residual

    def test_the_camera_is_continuous_with_the_weak_one(self):
        """A camera very far away gives the weak perspective's face."""
        landmarks = landmarks_of(coefficients=coefficients_of(5), rotation=rotation_of(10))
        far, weak = morphable(landmarks, camera="assumed", distance=1000), morphable(landmarks, camera="weak")
        np.testing.assert_allclose(far.vertices, weak.vertices, atol=0.5)

    def test_mixture_and_gaussian_agree_on_exact_points(self):
        """With good points the prior hardly matters."""
        landmarks = landmarks_of(coefficients=coefficients_of(6, 0.4))
        one, other = (morphable(landmarks, prior=p, noise=0.003) for p in ("mixture", "gaussian"))
        np.testing.assert_allclose(one.vertices, other.vertices, atol=3)

    def test_a_stronger_prior_stays_nearer_to_the_average(self):
        """Coefficients shrink as the strength grows."""
        landmarks = landmarks_of(coefficients=coefficients_of(7, 1.5))
        sizes = [
            np.linalg.norm(morphable(landmarks, strength=s, prior="gaussian").fit.identity) for s in (0.1, 10, 1e3)
        ]
        assert sizes[0] > sizes[1] > sizes[2]

    def test_an_outlier_hardly_moves_the_face(self):
        """One point at the other end of the picture changes no vertex by more than a pixel and a half."""
        landmarks = landmarks_of(coefficients=coefficients_of(8), rotation=rotation_of(10))
        spoiled = landmarks.points.copy()
        spoiled[4, :2] = (4000, 3000)
        clean, robust = morphable(landmarks), morphable(Landmarks(spoiled, "facemesh468"))
        assert np.abs(clean.vertices - robust.vertices).max() < 1.5

    def test_missing_points_are_said_and_borne(self):
        """A quarter of the points missing is a warning, and nearly the same face."""
        landmarks = landmarks_of(coefficients=coefficients_of(9))
        points = landmarks.points.copy()
        points[::4] = np.nan
        with pytest.warns(GraphfaceWarning, match="117 landmarks are missing"):
            holed = morphable(Landmarks(points, "facemesh468"))
        assert np.abs(holed.vertices - morphable(landmarks).vertices).mean() < 2

    def test_components_can_be_held_back(self):
        """Coefficients beyond the number asked for stay zero."""
        fit = morphable(landmarks_of(coefficients=coefficients_of(10)), identity=3, expression=0).fit
        assert np.count_nonzero(fit.identity) == 3
        assert not fit.expression.any()

    def test_no_steps_is_the_average_face(self):
        """With no step the closed-form pose of the mean face is returned."""
        with pytest.warns(GraphfaceWarning, match="did not converge"):
            mesh = morphable(landmarks_of(coefficients=coefficients_of(11)), steps=0)
        assert not mesh.fit.identity.any()

    def test_refuses_a_scheme_that_the_model_lacks(self):
        """The schemes that the model knows are named."""
        model = grid_model(landmarks={"facemesh468": np.arange(468, dtype=np.int32) % 144})
        with pytest.raises(UsageError, match="facemesh468"):
            morphable(Landmarks(np.zeros((68, 3), np.float32), "ibug68"), model=model)


class TestUnusable:
    @pytest.mark.parametrize("points", [np.full((468, 3), np.nan), np.full((468, 3), 5.0)])
    def test_points_that_are_no_face_are_refused(self, points):
        """All missing or all in one place is a clear error."""
        with pytest.raises(UnusableLandmarks):
            morphable(Landmarks(points.astype(np.float32), "facemesh468"))
