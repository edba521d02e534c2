"""Fits of one and of several photographs."""

from __future__ import annotations

import numpy as np
from faces import coefficients_of, landmarks_of, rotation_of

from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.fit import fit, fit_together
from graphface.nodes.morphable.fit_problem import Settings
from graphface.nodes.morphable.pose import Pose


class TestFit:
    def test_a_wrong_initial_pose_is_not_used(self):
        """An initial pose that explains the points worse than the closed form changes nothing."""
        landmarks = landmarks_of(coefficients=coefficients_of(1))
        wrong = Pose(rotation_of(150), 10.0, np.array([500.0, 0.0]))
        one, other = (fit(builtin_model(), landmarks, Settings(), start=start) for start in (None, wrong))
        np.testing.assert_array_equal(one.vertices, other.vertices)


class TestFitTogether:
    def test_sliding_jaws_of_several_photographs(self):
        """Each photograph's jaw slides in its own view."""
        coefficients = coefficients_of(2, 0.4)
        faces = [
            landmarks_of(coefficients=coefficients, rotation=rotation_of(yaw), scheme="ibug68") for yaw in (-30, 0, 30)
        ]
        meshes = fit_together(builtin_model(), faces, Settings())
        assert len(meshes) == 3
        assert max(mesh.fit.residual for mesh in meshes) < 0.03 * 150
        np.testing.assert_allclose(meshes[0].fit.identity, meshes[2].fit.identity, atol=1e-6)
