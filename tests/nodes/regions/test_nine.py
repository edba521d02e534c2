"""The nine regions of a face."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from portraits import landmarks_at

from graphface import UsageError
from graphface.nodes.landmark_schemes import ibug68
from graphface.nodes.regions.atlas import mean_face_coordinates
from graphface.nodes.regions.nine import nine
from graphface.nodes.types import REGIONS, Image
from graphface.testing import check_node

BLANK = Image(np.zeros((200, 200, 3), np.float32))


@pytest.fixture
def landmarks():
    return landmarks_at(100, 100, 90)


class TestNine:
    def test_a_partition(self, landmarks):
        """Every point of the face belongs to regions that sum to 1: the forehead's middle, temples and chin as well."""
        regions = nine(BLANK, landmarks)
        total = sum(getattr(regions, name) for name in REGIONS)
        face = mean_face_coordinates((200, 200), landmarks)[2]
        np.testing.assert_allclose(total, face, atol=1e-4)
        for point in (8, 9, 151, 168, 71, 200):
            x, y = np.round(landmarks.points[point, :2]).astype(int)
            assert total[y, x] > 0.999

    def test_frown_lines_are_in_one_region(self, landmarks):
        """The forehead reaches down between the brows."""
        x, y = np.round(landmarks.points[8, :2]).astype(int)
        assert nine(BLANK, landmarks).forehead[y, x] > 0.9

    def test_contours_alone(self, landmarks):
        """Without a partition what lies between the contours belongs to none, and regions share what they overlap."""
        regions = nine(BLANK, landmarks, partition=False)
        total = sum(getattr(regions, name) for name in REGIONS)
        assert total.max() <= 1 + 1e-5
        x, y = np.round(landmarks.points[8, :2]).astype(int)
        assert total[y, x] < 0.05

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
        assert all(getattr(regions, other)[y, x] < 0.5 for other in REGIONS if other != name)

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

    def test_a_large_face_has_the_regions_of_a_small_one(self, landmarks):
        """Regions are drawn on a small copy of a large photo, and lie where they lie in a small one."""
        factor = 6
        large = replace(landmarks, points=(landmarks.points + np.float32([0.5, 0.5, 0])) * factor - np.float32(0.5))
        photo = Image(np.zeros((200 * factor, 200 * factor, 3), np.float32))
        nose = nine(photo, large).nose.reshape(200, factor, 200, factor).mean(axis=(1, 3))
        assert np.abs(nose - nine(BLANK, landmarks).nose).max() < 0.1

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
