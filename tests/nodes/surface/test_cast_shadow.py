"""A shadow on the photo from what a network says on the crop."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import landmarks_at

from graphface.nodes.landmark_schemes import ibug68
from graphface.nodes.surface.cast_shadow import carried_over_features, cast_shadow, off_hair
from graphface.nodes.surface.face_crop import SIZE, face_crop
from graphface.nodes.types import Image

SIDE = 200
LANDMARKS = landmarks_at(100, 100, 60)
CROP = face_crop(LANDMARKS)
EVERYWHERE = np.ones((SIDE, SIDE), np.float32)
FREE = np.ones((SIZE, SIZE), np.float32)


def cast(probability, free=FREE, coverage=EVERYWHERE, brightness=0.5):
    photo = Image(np.full((SIDE, SIDE, 3), brightness, np.float32))
    return cast_shadow(CROP, probability.astype(np.float32), free, photo, LANDMARKS, coverage)


class TestCastShadow:
    def test_more_probable_than_not(self):
        """Half sure is no shadow, quite sure is a whole one, and in between it grows."""
        darkest = [cast(p * FREE).max() for p in (0.0, 0.5, 0.6, 0.7, 0.9, 1.0)]
        assert darkest[:2] == [0, 0]
        assert darkest == sorted(darkest)
        assert darkest[-1] == pytest.approx(1, abs=1e-3)

    def test_ends_within_the_crop(self):
        """No edge where the crop ends: from one pixel to the next it changes by a few percent."""
        shadow = cast(FREE)
        assert not shadow[[0, -1]].any()
        assert max(np.abs(np.diff(shadow, axis=axis)).max() for axis in (0, 1)) < 0.2

    def test_only_on_the_surface_and_off_hair(self):
        """Where there is no surface and on hair there is no shadow."""
        half = EVERYWHERE.copy()
        half[:, :100] = 0
        assert not cast(FREE, coverage=half)[:, :100].any()
        assert not cast(FREE, free=0 * FREE).any()

    @pytest.mark.parametrize("brightness", [np.nan, np.inf, -np.inf, 1e30])
    def test_impossible_photos(self, brightness):
        """What is no brightness guides no edge."""
        shadow = cast(FREE, brightness=brightness)
        assert 0 <= shadow.min() <= shadow.max() <= 1


class TestCarriedOverFeatures:
    def test_dark_eyes_are_no_shadow(self):
        """What is called shadow on the features alone goes."""
        middle = ibug68(LANDMARKS).points[36:42, :2].mean(axis=0)
        x, y = np.round(CROP.matrix[:, :2] @ middle + CROP.matrix[:, 2]).astype(int)
        only = 0 * FREE
        only[y - 1 : y + 2, x - 1 : x + 2] = 1
        assert carried_over_features(only, CROP, LANDMARKS).max() < 0.1

    def test_shadow_over_an_eye_stays(self):
        """A shadow of half of the face covers the eye in it."""
        half = FREE.copy()
        half[:, SIZE // 2 :] = 0
        carried = carried_over_features(half, CROP, LANDMARKS)
        assert carried[:, : SIZE // 2 - 15].min() > 0.9
        assert carried[:, SIZE // 2 + 15 :].max() < 0.1


class TestOffHair:
    def test_reach(self):
        """0 on hair and next to it, 1 far away."""
        hair = np.zeros((SIZE, SIZE), np.float32)
        hair[:20] = 1
        free = off_hair(hair)
        assert free[:21].max() < 0.2
        assert free[40:].min() > 0.999
