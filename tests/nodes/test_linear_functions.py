"""Local linear functions of color."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.linear_functions import linear_functions


@pytest.mark.parametrize("ridge", [1e-8, 1e-3])
def test_finds_a_linear_function(ridge, rng):
    """A map that is linear in color gets its own coefficients, but for what the ridge takes."""
    guide = rng.random((20, 20, 3), np.float32)
    map_ = guide @ np.float32([0.5, -0.25, 1]) + np.float32(0.1)
    found = linear_functions(guide, np.stack([map_, np.zeros_like(map_)], axis=2), 7, ridge)
    assert found.shape == (20, 20, 8)
    np.testing.assert_allclose(found[..., :4].mean(axis=(0, 1)), [0.5, -0.25, 1, 0.1], atol=0.03)
    np.testing.assert_allclose(found[..., 4:], 0, atol=1e-6)


def test_a_flat_guide_gives_means():
    """No color to depend on: the slopes are 0."""
    guide, map_ = np.full((9, 9, 3), 0.4, np.float32), np.full((9, 9, 1), 0.7, np.float32)
    found = linear_functions(guide, map_, 3, 1e-3)
    np.testing.assert_allclose(found[..., :3], 0, atol=1e-4)
    np.testing.assert_allclose(found[..., 3], 0.7, atol=1e-4)
