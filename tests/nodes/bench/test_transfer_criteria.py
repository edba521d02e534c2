"""The figures that transfers are judged by."""

import numpy as np
import pytest

from graphface.nodes.bench.transfer_criteria import albedo_distance, feature_similarity, seam
from graphface.nodes.bench.transfer_table import face_crop
from graphface.nodes.bench.transfer_truth import reinhard
from graphface.nodes.makeup.features import features
from graphface.nodes.types import Image


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


class TestReinhard:
    def test_statistics_become_the_references(self, rng):
        """Where no value is clipped, the mean colour is the reference's."""
        one, other = (Image((0.4 + 0.1 * rng.random((32, 32, 3)) * s).astype(np.float32)) for s in (1.0, 0.5))
        np.testing.assert_allclose(
            reinhard(one, other).pixels.mean(axis=(0, 1)), other.pixels.mean(axis=(0, 1)), atol=5e-3
        )

    def test_a_flat_photo(self):
        """No deviation to scale: finite."""
        flat = Image(np.full((8, 8, 3), 0.5, np.float32))
        assert np.isfinite(reinhard(flat, flat).pixels).all()


class TestFaceCrop:
    @pytest.mark.parametrize("side", [16, 300])
    def test_square(self, face, side):
        """The crop has the size that was asked for, smaller or larger than the face."""
        assert face_crop(face[0], face[1], side).shape == (side, side, 3)
