"""Path-traced heads: what is read of their folders, and their lights as scenes."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.bench.heads import LABELS, LIGHTS, heads_of, known_scene, true_direction
from graphface.nodes.render.irradiance import irradiance

AREA = {"direction": [0, 0, 2], "half_size": 10, "distance": 100, "radiance": [5, 5, 5]}
"""Solid angle (2 * 10 / 100)^2 = 0.04."""


class TestHeads:
    def test_maps(self, heads):
        """Pictures, labels, normals, albedo and depth are of one size; labels sum to 1."""
        (head,) = heads_of(heads)
        assert head.name == "gt01"
        for light in LIGHTS:
            assert head.photo(light).pixels.shape == (128, 128, 3)
        assert head.normals.shape == head.albedo.shape == head.labels.shape == (128, 128, len(LABELS))
        assert head.depth.shape == head.face.shape == (128, 128)
        np.testing.assert_allclose(head.labels.sum(axis=2), 1, atol=1e-6)
        np.testing.assert_array_equal(head.face, head.labels[..., 0] > 0.5)

    def test_points_where_there_are(self, heads, shared):
        """The drawn head has none, the traced ones 68."""
        assert heads_of(heads)[0].points68 is None
        assert heads_of(shared)[0].points68.shape == (68, 2)

    def test_of_another_family(self, shared):
        """The heads of families/ have all but the points."""
        for head in heads_of(shared / "families"):
            assert head.points68 is None
            assert set(head.lights) == set(LIGHTS)
            assert head.normals.shape == head.albedo.shape == (*head.face.shape, 3)

    def test_no_heads(self, tmp_path):
        """A folder without heads is named."""
        with pytest.raises(UnreadableFile, match="holds no heads"):
            heads_of(tmp_path)


class TestKnownScene:
    def test_units(self):
        """An ambient radiance of one is an irradiance of pi; an area light adds radiance times solid angle."""
        received = irradiance(known_scene({"ambient": 1.0, "area": [AREA]}), np.float32([[0, 0, 1], [0, 0, -1]]))
        np.testing.assert_allclose(received, [np.pi + 5 * 0.04, np.pi], rtol=1e-5)


class TestTrueDirection:
    def test_sum_of_irradiances(self):
        """Area lights weigh by solid angle times radiance; even light points nowhere."""
        side = {**AREA, "direction": [1, 0, 0], "radiance": [10, 10, 10]}
        np.testing.assert_allclose(true_direction({"area": [AREA, side]}), [0.4, 0, 0.4], rtol=1e-6)
        np.testing.assert_array_equal(true_direction({"area": []}), 0)
