"""Points on the photo."""

from __future__ import annotations

import numpy as np
import pytest
from values import landmarks, mesh

from graphface.nodes.pictures.points import draw_judgements, draw_landmarks, draw_pins, draw_visibility, frame_for
from graphface.nodes.types import Image, Judgement, Judgements, Landmarks, Mesh, Pins
from graphface.values.picture import View


class TestFrame:
    @pytest.mark.parametrize("size", [None, 50])
    def test_on_the_photo(self, size):
        """A pixel of the photo is where it is in the picture, at any size."""
        pixels = np.zeros((100, 200, 3), np.float32)
        photo = Image(pixels)
        frame = frame_for(View(size, lambda kind: photo if kind is Image else None), np.zeros((1, 2)))
        scale = frame.pixels.shape[1] / 200
        np.testing.assert_allclose(frame.places(np.array([[199.5, 99.5]])), [[200 * scale - 0.5, 100 * scale - 0.5]])

    def test_without_photo(self):
        """All points lie inside; one point, none and NaN are no error."""
        for points in (np.random.default_rng(1).normal(500, 90, (30, 2)), np.ones((1, 2)), np.zeros((0, 2))):
            frame = frame_for(View(100), points)
            places = frame.places(points)
            assert (places >= -0.5).all()
            assert (places <= np.array(frame.pixels.shape[1::-1])).all()
        assert frame_for(View(100), np.full((3, 2), np.nan)).pixels.size


class TestLandmarks:
    def test_dots(self):
        """Something is drawn at every point, and nothing far from all of them."""
        photo = Image(np.zeros((240, 320, 3), np.float32))
        found = landmarks()
        found = Landmarks(found.points * 4 + 40, "ibug68")
        pixels = draw_landmarks(found, View(above=lambda kind: photo if kind is Image else None)).pixels
        at = np.rint(found.points[:, :2]).astype(int)
        assert (pixels[at[:, 1], at[:, 0]].max(axis=1) > 60).all()
        assert not pixels[:20].any()

    def test_unknown_points(self):
        """NaN is counted, not drawn; another scheme has dots alone."""
        points = landmarks().points.copy()
        points[3] = np.nan
        assert draw_landmarks(Landmarks(points, "ibug68"), View(100)).note.endswith("1 points are unknown")
        assert draw_landmarks(Landmarks(points[:5], "mine"), View(100)).pixels.any()


def test_visibility():
    """Green where seen, red where not, on the mesh; a curve without one."""
    view = View(200, lambda kind: mesh() if kind is Mesh else None)
    seen, hidden = (draw_visibility(np.full(36, v, np.float32), view).pixels.astype(int) for v in (1, 0))
    assert (seen[..., 1] - seen[..., 0]).max() > 100
    assert (hidden[..., 0] - hidden[..., 1]).max() > 100
    assert "over their index" in draw_visibility(np.ones(36, np.float32), View()).note


def test_pins():
    """An arrow for each; none is a sentence."""
    assert draw_pins(Pins(np.float32([[0, 0, 30, 10]])), View(100)).note.startswith("1 pins")
    assert draw_pins(Pins(np.zeros((0, 4), np.float32)), View(100)).pixels.size


def test_judgements():
    """The dot lies at the darker point."""
    pairs = (Judgement((0.1, 0.5), (0.9, 0.5), "2"),)
    pixels = draw_judgements(Judgements(pairs), View(200)).pixels
    yellow = np.argwhere((pixels[..., 0] > 220) & (pixels[..., 2] < 100))
    assert yellow[:, 1].mean() > pixels.shape[1] / 2
