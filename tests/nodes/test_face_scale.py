"""The small copy that operators measure and smooth on."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.types import Landmarks


def eyes(apart: float) -> Landmarks:
    """Landmarks whose outer eye corners are so many pixels apart."""
    points = np.zeros((468, 3), np.float32)
    points[263, 0] = apart
    return Landmarks(points, "facemesh468")


def test_the_copy_has_the_asked_pixels_between_the_eyes() -> None:
    copy = face_scale(eyes(200), (600, 401, 3), resolution=50)
    assert copy == FaceScale(shape=(600, 401), size=(150, 100), scale=0.25, interocular=50.0)


def test_a_smaller_face_keeps_its_size() -> None:
    copy = face_scale(eyes(20), (60, 40), resolution=50)
    assert (copy.size, copy.scale, copy.interocular) == ((60, 40), 1.0, 20.0)


def test_means_are_kept_down_and_up(rng: np.random.Generator) -> None:
    copy, values = face_scale(eyes(80), (64, 48), resolution=20), rng.random((64, 48, 3), np.float32)
    small = copy.down(values)
    assert small.shape == (16, 12, 3)
    assert small.dtype == np.float32
    np.testing.assert_allclose(small, values.reshape(16, 4, 12, 4, 3).mean(axis=(1, 3)), atol=1e-6)
    large = copy.up(small)
    assert large.shape == values.shape
    assert large.mean() == pytest.approx(values.mean(), abs=0.02)


def test_at_full_size_nothing_changes(rng: np.random.Generator) -> None:
    copy, values = face_scale(eyes(10), (32, 24), resolution=64), rng.random((32, 24), np.float32)
    np.testing.assert_array_equal(copy.up(copy.down(values)), values)


def test_sides_stay_within_bounds() -> None:
    assert face_scale(eyes(1000), (100, 40), resolution=20, least=8).size == (8, 8)
    assert face_scale(eyes(100), (4000, 2000), resolution=100, most=1000).size == (1000, 500)


@pytest.mark.parametrize("apart", [0.0, float("nan"), 1e9])
def test_impossible_faces_give_a_usable_copy(apart: float) -> None:
    copy = face_scale(eyes(apart), (30, 20), resolution=64)
    assert min(copy.size) >= 1
    assert 0 < copy.scale <= 1
    assert 0 < copy.interocular < np.inf
