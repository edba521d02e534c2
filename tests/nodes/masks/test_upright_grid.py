"""The upright grid."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from portraits import landmarks_at

from graphface.nodes.masks.upright_grid import HEIGHT, UNIT, WIDTH, upright_grid


def ramp(height, width):
    """A picture of its own pixel coordinates, x and y."""
    y, x = np.mgrid[:height, :width].astype(np.float32)
    return np.stack([x, y], axis=2)


class TestUprightGrid:
    @given(st.floats(-3.1, 3.1), st.floats(5, 200), st.floats(-50, 400))
    def test_every_face_stands_in_the_same_place(self, roll, interocular, x):
        """At any position, size and roll a face has its points in the same pixels of the grid."""
        there = landmarks_at(x, 90, interocular, roll)
        here = landmarks_at(100, 100, 50)
        points = upright_grid(there).to_grid(there).points
        np.testing.assert_allclose(points, upright_grid(here).to_grid(here).points, atol=0.05)

    def test_one_unit(self):
        """The mean face's eye corners are UNIT pixels apart, and stay so in depth."""
        landmarks = landmarks_at(100, 100, 60, 0.4)
        assert upright_grid(landmarks).to_grid(landmarks).interocular == pytest.approx(UNIT, rel=0.01)


class TestSampled:
    @given(st.floats(-3.1, 3.1), st.floats(10, 60))
    def test_samples_are_where_they_should_be(self, roll, interocular):
        """A sampled picture of coordinates agrees with the grid's matrix, within a sixth of a pixel."""
        grid = upright_grid(landmarks_at(200, 200, interocular, roll))
        found = grid.sampled(ramp(400, 400))
        v, u = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)
        back = np.stack([found[..., 0], found[..., 1], np.ones((HEIGHT, WIDTH))], axis=2) @ grid.matrix.T
        inside = grid.inside((400, 400)) > 0
        inside[[0, -1]] = inside[:, [0, -1]] = False
        away = np.hypot(back[..., 0] - u, back[..., 1] - v)
        assert away[inside & _deep(found)].max() < 0.15

    def test_finer_grids_agree(self):
        """Two by two samples of the finer grid average to the coarse one's; OpenCV interpolates at 32nds of a pixel."""
        grid = upright_grid(landmarks_at(100, 100, 30, 0.2))
        fine = grid.sampled(ramp(200, 200), 2).reshape(HEIGHT, 2, WIDTH, 2, 2).mean(axis=(1, 3))
        coarse = grid.sampled(ramp(200, 200))
        deep = _deep(coarse, 200)
        np.testing.assert_allclose(fine[deep], coarse[deep], atol=0.15)

    @pytest.mark.parametrize("shape", [(1, 1), (1, 300), (300, 2)])
    @pytest.mark.parametrize("where", [(0.0, 0.0), (-500.0, 40.0), (1e4, 1e4)])
    @pytest.mark.parametrize("interocular", [0.01, 20.0, 3000.0])
    def test_any_photo(self, shape, where, interocular):
        """A photo of a pixel and a face far outside of it, a speck or huge: finite samples within its range."""
        grid = upright_grid(landmarks_at(*where, interocular))
        found = grid.sampled(np.full((*shape, 3), 0.25, np.float32))
        assert found.shape == (HEIGHT, WIDTH, 3)
        np.testing.assert_allclose(found, 0.25, atol=1e-6)


class TestInside:
    def test_beyond_the_frame(self):
        """A photo that ends at the face's middle covers about half of the grid."""
        inside = upright_grid(landmarks_at(100, 50, 40)).inside((200, 100))
        assert inside[:, : WIDTH // 2 - 1].any()
        assert not inside[:, WIDTH // 2 + 1 :].any()


class TestUnwarped:
    def test_there_and_back(self):
        """A smooth map warped onto the grid and back is unchanged."""
        grid = upright_grid(landmarks_at(100, 100, 30, 0.3))
        picture = ramp(200, 200)
        back = grid.unwarped(grid.sampled(picture), (200, 200))
        np.testing.assert_allclose(back[60:140, 60:140], picture[60:140, 60:140], atol=0.15)

    def test_nothing_beyond(self):
        """Beyond the grid a map is 0."""
        grid = upright_grid(landmarks_at(100, 100, 10))
        back = grid.unwarped(np.ones((HEIGHT, WIDTH, 2), np.float32), (200, 200))
        assert back[100, 100].tolist() == [1, 1]
        assert back[0, 0].tolist() == [0, 0]


def _deep(found, side=400):
    """Samples further than two pixels from the photo's border, where none was repeated."""
    return ((found > 2) & (found < side - 3)).all(axis=2)
