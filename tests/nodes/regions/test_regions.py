"""Nine regions in face coordinates, projected to a face."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import landmarks_at

from graphface import UsageError
from graphface.nodes.landmark_schemes import ibug68
from graphface.nodes.regions.atlas import NAMES, atlas, mean_face_coordinates
from graphface.nodes.regions.features import features
from graphface.nodes.regions.nine import nine
from graphface.nodes.types import Image
from graphface.testing import check_node

BLANK = Image(np.zeros((200, 200, 3), np.float32))


@pytest.fixture
def landmarks():
    return landmarks_at(100, 100, 90)


class TestNine:
    def test_sum_to_at_most_one(self, landmarks):
        """Regions share what they overlap."""
        regions = nine(BLANK, landmarks)
        assert sum(getattr(regions, name) for name in NAMES).max() <= 1 + 1e-5

    @pytest.mark.parametrize(
        ("name", "point"),
        [
            ("right_brow", 105), ("left_brow", 334), ("nose", 1), ("mouth", 13), ("forehead", 151),
            ("right_cheek", 50), ("left_cheek", 280), ("right_eye", 159), ("left_eye", 386),
        ],
    )  # fmt: skip
    def test_where_the_points_are(self, name, point, landmarks):
        """Each region is full at a point of the face that belongs to it, and all others are faint there."""
        regions = nine(BLANK, landmarks)
        x, y = np.round(landmarks.points[point, :2]).astype(int)
        assert getattr(regions, name)[y, x] > 0.5
        assert all(getattr(regions, other)[y, x] < 0.5 for other in NAMES if other != name)

    def test_mirror_images(self, landmarks):
        """On a symmetric face left regions are the right ones' mirror images."""
        regions = nine(Image(np.zeros((201, 201, 3), np.float32)), landmarks)
        for part in ("brow", "eye", "cheek"):
            left, right = getattr(regions, f"left_{part}"), getattr(regions, f"right_{part}")
            assert np.abs(left[:, :201] - right[:, 200::-1]).mean() < 0.003

    def test_scale_and_turn_with_the_face(self, landmarks):
        """A face twice as large has regions of four times the area; a turned face the same."""
        area = nine(BLANK, landmarks).mouth.sum()
        small, turned = landmarks_at(100, 100, 45), landmarks_at(100, 100, 90, 0.5)
        assert nine(BLANK, small).mouth.sum() == pytest.approx(area / 4, rel=0.05)
        assert nine(BLANK, turned).mouth.sum() == pytest.approx(area, rel=0.03)

    def test_softness(self, landmarks):
        """More softness, more pixels in between."""
        hard, soft = (nine(BLANK, landmarks, softness=s).mouth for s in (0.02, 0.2))
        between = [((m > 0.05) & (m < 0.95)).sum() for m in (hard, soft)]
        assert between[1] > 3 * between[0]

    def test_other_schemes_are_refused(self, landmarks):
        """68 points do not say where cheeks are."""
        with pytest.raises(UsageError, match="facemesh468"):
            nine(BLANK, ibug68(landmarks))

    def test_node(self, landmarks):
        """It keeps an operator's promises."""
        check_node(nine, BLANK, landmarks)


class TestFeatures:
    def test_eyes_nose_mouth_and_no_skin(self, landmarks):
        """1 on eyes, nose and mouth; 0 on cheeks, chin and forehead."""
        mask = features(BLANK, landmarks)
        at = {p: mask[tuple(np.round(landmarks.points[p, 1::-1]).astype(int))] for p in (159, 1, 13, 50, 280, 152, 151)}
        assert min(at[p] for p in (159, 1, 13)) > 0.9
        assert max(at[p] for p in (50, 280, 152, 151)) < 0.1

    def test_within_the_face(self, landmarks):
        """Nothing beyond the mesh."""
        covered = mean_face_coordinates((BLANK.height, BLANK.width), landmarks)[2]
        assert not features(BLANK, landmarks)[covered == 0].any()


class TestAtlas:
    def test_read_only(self):
        """What is drawn once cannot be drawn over."""
        with pytest.raises(ValueError, match="read-only"):
            atlas(0.08)["nose"][0, 0] = 1
