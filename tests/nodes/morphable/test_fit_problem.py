"""The problem of fitting one photograph."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from faces import grid_model, landmarks_of

from graphface import GraphfaceWarning, UsageError
from graphface.nodes.landmark_schemes import UnusableLandmarks
from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.fit_problem import Settings, fit_of_photo, reduced_model
from graphface.nodes.types import Image, Landmarks

REDUCED = reduced_model(builtin_model(), None, None, "mixture")


class TestReducedModel:
    def test_components(self):
        """At most as many components as the model has; their prior is the marginal."""
        reduced = reduced_model(builtin_model(), 3, 100, "mixture")
        assert reduced.identity == 3
        assert reduced.used.tolist() == [0, 1, 2, *range(15, 25)]
        assert reduced.prior.means.shape[1] == 13

    def test_gaussian_prior(self):
        """The single Gaussian is the standard normal distribution."""
        prior = reduced_model(builtin_model(), 2, 0, "gaussian").prior
        np.testing.assert_allclose(prior.precisions, np.eye(2)[None])


class TestFitOfPhoto:
    def test_principal_point(self):
        """The middle of the photo, or without a photo the median of the points."""
        photo = Image(np.zeros((100, 200, 3), np.float32))
        assert fit_of_photo(REDUCED, landmarks_of(), Settings(), photo).center == (99.5, 49.5)
        landmarks = landmarks_of()
        expected = np.median(landmarks.points[:, :2], axis=0)
        np.testing.assert_allclose(fit_of_photo(REDUCED, landmarks, Settings(), None).center, expected, atol=1e-3)

    def test_missing_landmarks(self):
        """Missing landmarks are left out, with a warning."""
        landmarks = landmarks_of()
        landmarks.points[:100] = np.nan
        with pytest.warns(GraphfaceWarning, match="100 landmarks are missing"):
            found = fit_of_photo(REDUCED, landmarks, Settings(), None)
        assert found.known.tolist() == list(range(100, 468))
        assert found.count == 468

    def test_too_few_landmarks(self):
        """Fewer than 6 are refused."""
        landmarks = landmarks_of()
        landmarks.points[5:] = np.nan
        with pytest.raises(UnusableLandmarks, match="5 of 468"):
            fit_of_photo(REDUCED, landmarks, Settings(), None)

    def test_schemes(self):
        """FaceMesh points are reduced to a model that has only the 68; the reverse is refused."""
        model = grid_model()
        reduced = reduced_model(model, None, None, "mixture")
        assert fit_of_photo(reduced, landmarks_of(), Settings(), None).count == 68
        facemesh_only = replace(builtin_model(), landmarks={"facemesh468": builtin_model().landmarks["facemesh468"]})
        other = reduced_model(facemesh_only, None, None, "mixture")
        with pytest.raises(UsageError, match="'facemesh468'"):
            fit_of_photo(other, Landmarks(np.zeros((68, 3), np.float32), "ibug68"), Settings(), None)

    @pytest.mark.parametrize(
        ("camera", "expected"), [("weak", (0, 0)), ("assumed", (0.1, 0)), ("estimated", (0.1, 0.05))]
    )
    def test_camera(self, camera, expected):
        """Expected inverse distance and its standard deviation."""
        problem = fit_of_photo(REDUCED, landmarks_of(), Settings(camera), None).problem
        assert problem.nearness == expected
