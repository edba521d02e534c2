"""Jaw landmarks on the visible outline."""

from __future__ import annotations

import numpy as np
from faces import landmarks_of, rotation_of

from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.contour import jaw_lines, on_outline, sliding_jaw
from graphface.nodes.morphable.fit_problem import Settings, fit_of_photo, reduced_model
from graphface.nodes.morphable.solve import View


class TestContour:
    def test_the_chin_stays_and_candidates_run_inwards(self):
        """Every jaw line starts at its own vertex and comes nearer to the midline."""
        model = builtin_model()
        lines = jaw_lines(model)
        np.testing.assert_array_equal(lines[:, 0], model.landmarks["ibug68"][:17])
        assert (lines[8] == lines[8, 0]).all()
        assert (np.abs(model.mean[lines[3:6, -1], 0]) < np.abs(model.mean[lines[3:6, 0], 0])).all()

    def test_the_outline_slides_on_the_far_side_only(self):
        """On a face turned to the right, the outline on the right comes from further inside; on the left it stays."""
        model = builtin_model()
        rotation = rotation_of(50)
        flat = (model.mean[jaw_lines(model)] @ rotation.T)[..., :2]
        chosen = on_outline(flat, rotation[:2, 0], np.arange(17))
        assert (chosen[11:16] > 0).any()
        assert (chosen[3:7] == 0).all()


class TestSlidingJaw:
    def test_only_jaw_points_move(self):
        """In a turned view jaw points on the far side get other vertices; all other points keep theirs."""
        model = builtin_model()
        photo = fit_of_photo(
            reduced_model(model, None, None, "mixture"), landmarks_of(scheme="ibug68"), Settings(), None
        )
        problem = photo.problem
        turned = View(rotation_of(50), 150.0, np.zeros(2), 0.0, np.zeros(len(problem.directions)))
        moved = (photo.update(problem, turned).mean != problem.mean).any(axis=1)
        assert moved[:17].any()
        assert not moved[17:].any()

    def test_no_jaw_points(self):
        """Without jaw points there is nothing to update."""
        assert sliding_jaw(builtin_model(), np.arange(25), np.arange(17, 68)) is None
