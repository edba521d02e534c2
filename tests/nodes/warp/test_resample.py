"""The reference's photo, maps and detail map at the input's pixels."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import Correspondence, DetailMap, Image, Paint
from graphface.nodes.warp import resample
from graphface.nodes.warp.mesh import mesh as correspond


def shifted(size: int, dx: float, dy: float) -> Correspondence:
    y, x = np.mgrid[:size, :size].astype(np.float32)
    ones = np.ones((size, size), np.float32)
    return Correspondence(np.dstack([x + np.float32(dx), y + np.float32(dy)]), ones, ones, (size, size))


class TestPhoto:
    def test_mirrored_values_stand_in(self, make_face):
        """What a turned reference hides comes from its other half: no value of the picture's edge is left."""
        _, _, mesh, surface = make_face()
        photo, _, other, other_surface = make_face(yaw=70)
        found = correspond(surface, mesh, other_surface, other)
        assert np.isfinite(resample.photo(photo, found).pixels).all()
        alone = Correspondence(found.places, found.inside, found.valid, found.size)
        changed = np.abs(resample.photo(photo, found).pixels - resample.photo(photo, alone).pixels).max(axis=2)
        assert changed[found.mirrored_valid == 0].max() == 0
        assert changed[found.mirrored_valid > 0.5].mean() > 0.01

    def test_keeps_the_encoding(self, rng):
        """Pixels are resampled as they are encoded; alpha is dropped."""
        photo = Image(rng.random((8, 8, 3), np.float32), alpha=np.ones((8, 8), np.float32), encoding="linear")
        moved = resample.photo(photo, shifted(8, 1, 0))
        np.testing.assert_allclose(moved.pixels[:, :7], photo.pixels[:, 1:], atol=1e-6)
        assert (moved.encoding, moved.alpha) == ("linear", None)


class TestDetail:
    def test_every_part_of_a_detail_map(self, rng):
        """Offset and gain are both resampled; a part that is not there stays away."""
        offset, gain = (rng.random((8, 8, 3), np.float32) for _ in range(2))
        moved = resample.detail(DetailMap(offset, gain), shifted(8, 1, 0))
        np.testing.assert_allclose(moved.offset[:, :7], offset[:, 1:], atol=1e-6)
        np.testing.assert_allclose(moved.gain[:, :7], gain[:, 1:], atol=1e-6)
        assert resample.detail(DetailMap(offset), shifted(8, 1, 0)).gain is None


class TestMask:
    def test_stays_a_mask(self):
        """Cubic interpolation overshoots at an edge; a mask resampled by it does not leave 0..1."""
        step = np.zeros((16, 16), np.float32)
        step[:, 8:] = 1
        got = resample.mask(step, shifted(16, 0.5, 0))
        assert got.min() >= 0
        assert got.max() <= 1
        np.testing.assert_allclose(got[:, 7], 0.5, atol=0.02)


class TestPaint:
    def test_every_part_of_a_layer(self, rng):
        """Opacity and departure are both resampled, within their ranges; the skin of the wearer stays."""
        opacity, departure = rng.random((8, 8), np.float32), rng.random((8, 8, 3), np.float32)
        skin = np.float32([0.8, 0.6, 0.5])
        moved = resample.paint(Paint(opacity, departure, skin), shifted(8, 1, 0))
        np.testing.assert_allclose(moved.opacity[:, :7], opacity[:, 1:], atol=1e-6)
        np.testing.assert_allclose(moved.departure[:, :7], departure[:, 1:], atol=1e-6)
        assert moved.opacity.max() <= 1
        assert moved.skin is skin
