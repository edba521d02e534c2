"""The figures that transfers are judged by."""

import numpy as np
import pytest

from graphface.nodes.bench.transfer_criteria import (
    Criteria,
    Refused,
    albedo_distance,
    criteria,
    feature_similarity,
    landmark_shift,
    seam,
)
from graphface.nodes.io.image_write import write_picture
from graphface.nodes.makeup.features import features
from graphface.nodes.types import Landmarks


@pytest.fixture
def face_file(request, tmp_path):
    """A photograph of a face as a file."""
    from skimage.data import astronaut

    request.getfixturevalue("networks")
    write_picture(np.ascontiguousarray(astronaut()[:256, 96:352]), tmp_path / "me.png")
    return tmp_path / "me.png"


@pytest.fixture
def face(make_face):
    photo, landmarks, _, _ = make_face(size=200, scale=0.45)
    return photo, landmarks, features(photo, landmarks)


class TestFeatureSimilarity:
    def test_nothing_changed(self, face):
        """A picture is wholly similar to itself."""
        photo, landmarks, found = face
        assert feature_similarity(photo.pixels, photo.pixels, found, landmarks) == pytest.approx(1)

    def test_a_new_tone_counts_little(self, face):
        """A darker skin is nearly as similar; other shapes are not."""
        photo, landmarks, found = face
        toned = feature_similarity(photo.pixels, photo.pixels * np.float32(0.8), found, landmarks)
        other = feature_similarity(photo.pixels, np.ascontiguousarray(photo.pixels[::-1]), found, landmarks)
        assert toned > 0.9
        assert other < 0.7


class TestSeam:
    @pytest.fixture
    def core(self):
        x = np.arange(40, dtype=np.float32)
        return np.tile(np.clip((x - 15) / 10, 0, 1), (40, 1))

    def test_none(self, core, rng):
        """Where nothing changed the edge is as it was."""
        pixels = rng.random((40, 40, 3), np.float32)
        assert seam(pixels, pixels, core) == pytest.approx(1)

    def test_a_step(self, core, rng):
        """A step across the edge is told by a figure above 1."""
        before = (0.4 + 0.02 * rng.random((40, 40, 3))).astype(np.float32)
        after = before + (np.arange(40) > 20)[None, :, None].astype(np.float32) * np.float32(0.4)
        assert seam(before, after, core) > 1.5


class TestAlbedoDistance:
    def test_equal_and_apart(self, face):
        """0 for the same albedo; the length of the difference where it is constant."""
        found, ones = face[2], np.ones((200, 200, 3), np.float32)
        assert albedo_distance(ones, ones, found, ones[..., 0]) == 0
        assert albedo_distance(ones, ones + np.float32(0.1), found, ones[..., 0]) == pytest.approx(
            0.1 * np.sqrt(3), rel=1e-3
        )


class TestLandmarkShift:
    def test_in_eye_distances(self, face):
        """Everything moved by a tenth of the eye distance is a shift of 0.1."""
        landmarks = face[1]
        moved = Landmarks(landmarks.points + np.float32([0.1 * landmarks.interocular, 0, 0]), landmarks.scheme)
        assert landmark_shift(landmarks, landmarks) == 0
        assert landmark_shift(landmarks, moved) == pytest.approx(0.1, rel=1e-3)


class TestCriteria:
    def test_a_photo_under_itself(self, face_file):
        """Nothing moves, the seam is the photo's own, and what it cost is told."""
        (found,) = criteria([face_file], [face_file])
        assert isinstance(found, Criteria)
        assert found.shift < 0.02
        assert found.seam == pytest.approx(1, abs=0.1)
        assert found.albedo_before < 0.05
        assert found.milliseconds > 0

    def test_a_pair_that_cannot_be_made(self, networks, face_file, tmp_path):
        """The reason stands in its place."""
        (tmp_path / "not.png").write_text("no picture")
        (found,) = criteria([face_file], [tmp_path / "not.png"])
        assert isinstance(found, Refused)
        assert "not.png" in found.reason
