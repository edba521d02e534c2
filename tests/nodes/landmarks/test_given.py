"""Points that the user gives."""

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.landmark_schemes import UnusableLandmarks
from graphface.nodes.landmarks.given import given
from graphface.nodes.types import Image, Landmarks

PHOTO = Image(np.zeros((200, 300, 3), np.float32))


def face() -> Landmarks:
    """Points spread over the photo, all different."""
    return Landmarks(np.random.default_rng(0).uniform(10, 190, (68, 3)).astype(np.float32), "ibug68")


class TestGiven:
    def test_good_points_pass(self):
        """Points on the photo are returned unchanged."""
        points = face()
        assert given(PHOTO, points) is points

    @pytest.mark.parametrize(
        ("points", "words"),
        [
            (Landmarks(face().points + 1000, "ibug68"), "another size"),
            (Landmarks(face().points[:60], "ibug68"), r"\(60, 3\)"),
            (Landmarks(face().points, "dlib"), "known: facemesh468"),
            (Landmarks(face().points * np.float32(np.nan), "ibug68"), "not numbers"),
            (Landmarks(np.full((68, 3), 50, np.float32), "ibug68"), "less than a pixel apart"),
        ],
    )
    def test_unusable(self, points, words):
        """Points that cannot lie on this face are refused with the reason."""
        with pytest.raises(UnusableLandmarks, match=words):
            given(PHOTO, points)

    def test_mostly_outside(self):
        """A face mostly outside the photo is used, with a warning."""
        with pytest.warns(GraphfaceWarning, match="given points lie in the photo"):
            given(PHOTO, Landmarks(face().points - np.array([120, 0, 0], np.float32), "ibug68"))
