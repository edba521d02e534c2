"""The crop: reading and mapping back agree, at every place, size and angle."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.landmarks.crop import Crop, crop_about

angles = st.floats(-np.pi, np.pi)


def blob(x: float, y: float, spread: float, size: int = 200) -> np.ndarray:
    """A bright spot at (x, y), float32 (size, size, 3)."""
    v, u = np.mgrid[:size, :size]
    spot = np.exp(-((u - x) ** 2 + (v - y) ** 2) / (2 * spread**2))
    return np.repeat(spot[..., None], 3, axis=2).astype(np.float32)


class TestRoundTrip:
    @settings(deadline=None, max_examples=50)
    @given(st.floats(40, 150), st.floats(40, 150), st.floats(100, 900), angles)
    def test_a_spot_is_read_where_it_maps_from(self, column, row, side, angle):
        """A spot at the place that a crop pixel maps to is read at that pixel, whether the crop is shrunk or not."""
        there = Crop((0, 0), side, angle).to_picture(np.array([[column, row, 0]]), 192)[0]
        crop = Crop((100.3 - there[0], 99.6 - there[1]), side, angle)
        read = crop.read(blob(100.3, 99.6, max(2, side / 60)), 192)[..., 0].astype(np.float64) ** 2
        rows, columns = np.mgrid[:192, :192]
        found = (columns * read).sum() / read.sum(), (rows * read).sum() / read.sum()
        np.testing.assert_allclose(found, (column, row), atol=0.1)

    @given(angles, st.floats(10, 500))
    def test_depth_scales_with_the_crop_and_points_to_the_viewer(self, angle, side):
        """z is scaled like x and y, turned round, and does not depend on the angle."""
        points = np.array([[0, 0, 10.0]])
        assert np.isclose(Crop((5, 5), side, angle).to_picture(points, 100)[0, 2], -10 * side / 100, rtol=1e-5)


class TestOutside:
    @settings(deadline=None, max_examples=50)
    @given(st.floats(-500, 700), st.floats(-500, 700), st.floats(0, 3000), angles)
    def test_any_crop_can_be_read(self, x, y, side, angle):
        """Crops partly or wholly outside the picture, of no size or a huge one, give finite pixels in range."""
        read = Crop((x, y), side, angle).read(np.ones((30, 40, 3), np.float32), 64)
        assert read.shape == (64, 64, 3)
        assert np.isfinite(read).all()
        assert read.min() >= 0
        assert read.max() <= 1 + 1e-5


class TestCropAbout:
    @given(angles)
    def test_turned_points_give_the_same_square_turned(self, angle):
        """The crop about turned points is level with the eyes, has the same side and the turned centre."""
        cos, sin = np.cos(angle), np.sin(angle)
        points = np.array([[0, 0], [100, 0], [50, 80]], float)
        turned = points @ np.array([[cos, sin], [-sin, cos]])
        crop = crop_about(turned, turned[:2], margin=1.5)
        assert np.isclose(crop.side, 150)
        np.testing.assert_allclose(crop.center, np.array([50, 40]) @ np.array([[cos, sin], [-sin, cos]]), atol=1e-9)
        assert np.isclose(np.cos(crop.angle - angle), 1)

    def test_one_point(self):
        """Points that all coincide give a square of no size, not an error."""
        assert crop_about(np.ones((5, 2)), np.ones((2, 2)), margin=1.5).side == 0
