"""Masks of the parts of a face."""

import numpy as np
import pytest

from graphface import GraphfaceWarning, UsageError
from graphface.nodes.makeup.features import features
from graphface.nodes.types import Landmarks


class TestFeatures:
    def test_from_top_to_bottom(self, face):
        """Brows lie above eyes, eyes above the nose, the nose above the lips."""
        found = face.features

        def middle(mask):
            return np.average(np.indices(mask.shape)[0], weights=mask)

        assert middle(found.brows) < middle(found.eyes) < middle(found.nose) < middle(found.lips)
        assert found.eyes[tuple(face.landmarks.points[159, 1::-1].astype(int))] > 0.1

    def test_within_bounds(self, face):
        """Every mask is between 0 and 1, and none is empty."""
        for mask in vars(face.features).values():
            assert mask.min() >= 0
            assert 0.1 < mask.max() <= 1

    def test_other_landmarks_are_refused(self, face):
        """68 points do not say where lids end and cheeks begin."""
        with pytest.raises(UsageError, match="facemesh468"):
            features(face.photo, Landmarks(np.zeros((68, 3), np.float32), "ibug68"))

    def test_outside_of_the_photo(self, face):
        """A face beyond the frame has no features in it."""
        far = Landmarks(face.landmarks.points + np.float32(5000), "facemesh468")
        assert max(mask.max() for mask in vars(features(face.photo, far)).values()) == 0

    def test_landmarks_that_are_not_finite_are_left_out(self, face):
        """One missing point costs no more than its corner of the outline, and is reported."""
        points = face.landmarks.points.copy()
        points[70] = np.nan
        with pytest.warns(GraphfaceWarning, match="not finite"):
            found = features(face.photo, Landmarks(points, "facemesh468"))
        assert found.brows.sum() > 0.8 * face.features.brows.sum()
