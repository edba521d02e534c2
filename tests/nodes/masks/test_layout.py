"""Geometry of one face at working size."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import landmarks_at

from graphface.nodes.landmark_schemes import ibug68
from graphface.nodes.masks.layout import layout_of
from graphface.nodes.masks.window import window_about

LANDMARKS = landmarks_at(80, 90, 40.0)


def layout(landmarks=LANDMARKS, shape=(160, 160)):
    return layout_of(landmarks, window_about(landmarks, shape, 40))


class TestLayoutOf:
    def test_distances_are_signed_and_in_units(self):
        """Negative inside, positive outside, growing by one in an inter-ocular distance."""
        outline = layout().outline
        assert outline[90, 80] < -0.4
        assert outline[90, 155] - outline[90, 135] == pytest.approx(0.5, abs=0.05)

    def test_positions(self):
        """Right and up from the middle of the face, in units."""
        found = layout()
        assert found.right[90, 120] == pytest.approx(1, abs=0.05)
        assert found.up[50, 80] == pytest.approx(1, abs=0.05)

    def test_features(self):
        """Eyes and mouth are features, cheeks and forehead are not."""
        found = layout().features
        x, y = LANDMARKS.points[[159, 13, 50, 9], :2].round().astype(int).T
        assert found[y, x].tolist() == [True, True, False, False]

    def test_schemes_agree(self):
        """The 68 points place eyes and mouth as the 468 do."""
        np.testing.assert_array_equal(layout(ibug68(LANDMARKS)).features, layout().features)

    @pytest.mark.parametrize("where", [(-500, 80), (80, 1e5)])
    def test_outside_the_frame(self, where):
        """A face outside the frame has finite distances."""
        found = layout(landmarks_at(*where, 40.0))
        assert all(np.isfinite(m).all() for m in (found.outline, found.head, found.neck, found.right, found.up))

    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_landmarks_of_nan(self):
        """Landmarks of NaN are a face that is nowhere."""
        landmarks = landmarks_at(80, 90, 40.0)
        landmarks.points[:] = np.nan
        assert (layout(landmarks).outline == 9).all()
