"""Optical flow refines a correspondence where that makes two faces match, and only there."""

from dataclasses import replace

import numpy as np
import pytest

from graphface import GraphfaceWarning
from graphface.nodes.flow import deepflow, dis, farneback, none, tvl1
from graphface.nodes.types import Image
from graphface.nodes.warp.mesh import mesh as correspond

METHODS = [dis.dis, farneback.farneback, deepflow.deepflow, tvl1.tvl1]


def blobs(size: int, shift: float = 0.0) -> Image:
    """Dark and bright spots over the whole picture, moved to the right."""
    y, x = np.mgrid[:size, :size].astype(np.float32)
    x = x - np.float32(shift)
    waves = np.sin(x / 3.1) * np.cos(y / 3.7) + np.sin((x + y) / 5.3)
    return Image(np.repeat((0.5 + 0.15 * waves)[..., None], 3, axis=2).astype(np.float32))


@pytest.fixture
def pair(make_face):
    _, landmarks, mesh, surface = make_face(size=200, scale=0.5)
    return correspond(surface, mesh, surface, mesh), landmarks


def deep_inside(correspondence):
    import cv2

    return cv2.erode(correspondence.inside, np.ones((41, 41))) > 0


@pytest.mark.parametrize("method", METHODS)
class TestRefined:
    def test_a_shift_is_found(self, pair, method):
        """Where the reference's features lie 3 pixels off the meshes' word, most of that is corrected."""
        correspondence, landmarks = pair
        got = method(blobs(200), blobs(200, shift=3.0), correspondence, landmarks)
        moved = (got.places - correspondence.places)[deep_inside(correspondence)]
        assert 1.5 < np.median(moved[:, 0]) < 3.5
        assert abs(np.median(moved[:, 1])) < 0.5

    def test_equal_pictures_stay(self, pair, method):
        """What matches already is not moved."""
        correspondence, landmarks = pair
        got = method(blobs(200), blobs(200), correspondence, landmarks)
        np.testing.assert_array_equal(got.places, correspondence.places)

    def test_flat_pictures_stay(self, pair, method):
        """Where there is nothing to match the meshes win."""
        correspondence, landmarks = pair
        flat = Image(np.full((200, 200, 3), 0.5, np.float32))
        got = method(flat, flat, correspondence, landmarks)
        np.testing.assert_allclose(got.places, correspondence.places, atol=0.05)

    def test_unrelated_pictures_move_little(self, pair, method, rng):
        """Two fields of noise have no flow to trust: no place moves further than the reach."""
        correspondence, landmarks = pair
        one, other = (Image(rng.random((200, 200, 3), np.float32)) for _ in range(2))
        got = method(one, other, correspondence, landmarks)
        assert np.isfinite(got.places).all()
        assert np.abs(got.places - correspondence.places).max() < 0.15 * landmarks.interocular


class TestSmallFaces:
    def test_too_small_to_match(self, make_face):
        """A face of a few pixels keeps the meshes' correspondence, and says so."""
        photo, landmarks, mesh, surface = make_face(size=24, scale=0.25)
        correspondence = correspond(surface, mesh, surface, mesh)
        with pytest.warns(GraphfaceWarning, match="too few"):
            assert dis.dis(photo, photo, correspondence, landmarks) is correspondence

    def test_nothing_inside(self, pair):
        """Without any mesh in the picture nothing is done."""
        correspondence, landmarks = pair
        empty = replace(correspondence, inside=np.zeros_like(correspondence.inside))
        assert dis.dis(blobs(200), blobs(200), empty, landmarks) is empty


class TestNone:
    def test_is_the_identity(self, pair):
        """The correspondence as it comes."""
        correspondence, landmarks = pair
        assert none.none(blobs(200), blobs(200, 3), correspondence, landmarks) is correspondence
