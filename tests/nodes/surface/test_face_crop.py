"""The upright crop about a face."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import landmarks_at

from graphface.nodes.landmark_schemes import ibug68
from graphface.nodes.surface.face_crop import INTEROCULAR, SIZE, face_crop


def eyes(crop, landmarks):
    points = ibug68(landmarks).points[[36, 45], :2]
    return points @ crop.matrix[:, :2].T + crop.matrix[:, 2]


class TestFaceCrop:
    @pytest.mark.parametrize("roll", [0.0, 0.7, 3.0, -1.6])
    @pytest.mark.parametrize("interocular", [20, 300])
    def test_upright(self, roll, interocular):
        """However a face is turned and however large, its eyes are level and so far apart."""
        landmarks = landmarks_at(200, 150, interocular, roll)
        crop = face_crop(landmarks)
        left, right = eyes(crop, landmarks)
        assert abs(right[1] - left[1]) < 1.5
        assert right[0] - left[0] == pytest.approx(INTEROCULAR, rel=0.15)
        assert abs((left + right)[0] / 2 - SIZE / 2) < 3

    @pytest.mark.parametrize("roll", [0.0, 0.5, -2.0])
    def test_vectors_turn_with_the_picture(self, roll):
        """The vector up the face is up in the crop, and turns back."""
        crop = face_crop(landmarks_at(100, 100, 50, roll))
        right, up = ((crop.matrix[:, :2].T @ v) / crop.scale for v in ((1.0, 0.0), (0.0, -1.0)))
        for seen, expected in ((right, (1, 0, 0)), (up, (0, 1, 0))):
            vector = np.float32([seen[0], -seen[1], 0])
            np.testing.assert_allclose(crop.turned(vector), expected, atol=1e-5)
            np.testing.assert_allclose(crop.turned(crop.turned(vector), back=True), vector, atol=1e-5)

    def test_there_and_back(self):
        """A smooth map comes back from the crop as it was, but for the crop's edges."""
        landmarks = landmarks_at(150, 150, 60, 0.3)
        _, x = np.mgrid[:300, :300].astype(np.float32)
        smooth = np.sin(x / 25)[..., None] * np.ones(3, np.float32)
        crop = face_crop(landmarks)
        window = crop.window(smooth.shape)
        back = crop.unwarped(crop.sampled(smooth), window)
        middle = (slice(130, 170), slice(130, 170))
        full = np.zeros_like(smooth)
        full[window[0] : window[1], window[2] : window[3]] = back
        np.testing.assert_allclose(full[middle], smooth[middle], atol=0.02)
        assert not full[0, 0].any()

    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_no_face(self):
        """Landmarks that are no numbers, or fall together, give a crop with finite numbers."""
        for value in (np.nan, 5.0):
            landmarks = landmarks_at(30, 30, 10)
            landmarks.points[:] = value
            assert np.isfinite(face_crop(landmarks).matrix).all()
