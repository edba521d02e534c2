"""The network that refines normals: what it sees, and what it says."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import landmarks_at

from graphface.nodes.harmonics import ambient
from graphface.nodes.surface.face_crop import SIZE, face_crop
from graphface.nodes.surface.normal_network import (
    CHANNELS,
    COLORS,
    COVERAGE,
    NETWORK,
    NORMALS,
    SHADING,
    corrections,
    network_input,
    shipped_weights,
    unshuffled,
)
from graphface.nodes.types import Image, Surface


def seen_of(brightness):
    """An even grey picture with normals towards the camera, under even light."""
    landmarks = landmarks_at(100, 100, 60)
    ones, normals = np.ones((200, 200), np.float32), np.zeros((200, 200, 3), np.float32)
    normals[..., 2] = 1
    surface = Surface(normals, 0 * ones, ones, np.full(ones.shape, -1, np.int32), normals)
    photo = Image(np.full((200, 200, 3), brightness, np.float32))
    return network_input(face_crop(landmarks), photo, surface, ones, ambient(np.float32(0.5), 1))


class TestNetworkInput:
    @pytest.mark.parametrize("brightness", [0.1, 0.5, 1])
    def test_relative_to_the_mean(self, brightness):
        """An even picture is 0 however bright, and so is its shading; the normals are as they were."""
        seen = seen_of(brightness)
        assert seen.shape == (SIZE, SIZE, CHANNELS)
        np.testing.assert_allclose(seen[..., COLORS:NORMALS], 0, atol=1e-5)
        np.testing.assert_allclose(seen[..., SHADING], 0, atol=1e-5)
        np.testing.assert_allclose(seen[..., NORMALS:COVERAGE], [[[0, 0, 1]]] + 0 * seen[..., :3], atol=1e-5)

    def test_black(self):
        """Nothing is divided by 0."""
        assert np.isfinite(seen_of(0)).all()


class TestCorrections:
    def test_shipped_weights(self):
        """The weights that come with the package fit the network; on an even picture they change normals little."""
        change, shadow = corrections(seen_of(0.5), shipped_weights())
        assert change.shape == (SIZE, SIZE, 3)
        assert 0 < np.abs(change).mean() < 0.3
        assert shadow.shape == (SIZE, SIZE)
        assert 0 <= shadow.min() <= shadow.max() <= 1


class TestUnshuffled:
    def test_channels(self):
        """The four pixels of a cell stand together, channel by channel."""
        values = np.arange(4 * 4 * CHANNELS, dtype=np.float32).reshape(4, 4, CHANNELS)
        cells = unshuffled(values)
        assert cells.shape[2] == NETWORK.channels
        np.testing.assert_array_equal(cells[0, 0, :4], values[:2, :2, COLORS].ravel())
