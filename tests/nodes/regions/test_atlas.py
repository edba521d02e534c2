"""The regions on the mean face, and their projection."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import landmarks_at

from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.regions.atlas import REACH, SIDE, atlas, mean_face_coordinates, projected
from graphface.nodes.types import REGIONS, Image

BLANK = Image(np.zeros((200, 200, 3), np.float32))


class TestAtlas:
    def test_names(self):
        """A map for each of the nine regions."""
        assert tuple(atlas(0.08)) == REGIONS
        assert {drawn.shape for drawn in atlas(0.08).values()} == {(SIDE, SIDE)}

    def test_left_and_right_are_the_persons(self):
        """The right brow lies in the left half of the picture."""
        columns = np.arange(SIDE)
        assert np.average(columns, weights=atlas(0.08)["right_brow"].sum(axis=0)) < SIDE / 2

    def test_read_only(self):
        """What is drawn once cannot be drawn over."""
        with pytest.raises(ValueError, match="read-only"):
            atlas(0.08)["nose"][0, 0] = 1


class TestMeanFaceCoordinates:
    def test_at_a_landmark(self):
        """The pixel at a landmark shows that point of the mean face, whatever the pose in the picture."""
        landmarks = landmarks_at(100, 100, 90, roll=0.3)
        x, y, covered = mean_face_coordinates((200, 200), landmarks)
        for point in (4, 50, 280):
            column, row = np.round(landmarks.points[point, :2]).astype(int)
            assert covered[row, column] == 1
            np.testing.assert_allclose((x[row, column], y[row, column]), facemesh_topology().mean[point, :2], atol=0.02)


class TestProjected:
    def test_within_the_face(self):
        """A map that is 1 everywhere becomes the coverage of the face."""
        landmarks = landmarks_at(100, 100, 90)
        (found,) = projected([np.ones((SIDE, SIDE), np.float32)], BLANK, landmarks)
        np.testing.assert_allclose(found, mean_face_coordinates((200, 200), landmarks)[2], atol=1e-6)

    def test_a_gradient(self):
        """A map of the mean face's own x gives that coordinate."""
        x = np.tile(np.linspace(-REACH, REACH, SIDE, dtype=np.float32), (SIDE, 1))
        landmarks = landmarks_at(100, 100, 90)
        (found,) = projected([x], BLANK, landmarks)
        expected, _, covered = mean_face_coordinates((200, 200), landmarks)
        np.testing.assert_allclose(found, expected * covered, atol=1e-3)
