"""The blended detail map."""

import numpy as np

from graphface.nodes.makeup.detail import detail
from graphface.nodes.makeup.keep import keep
from graphface.nodes.types import DetailMap


class TestDetail:
    def test_elsewhere_it_is_the_references(self, face, rng):
        """Far from eyes, nose and mouth the map is the reference's, and in the openings the input's."""
        own, other = (DetailMap(rng.random((200, 200, 3), np.float32)) for _ in range(2))
        blended = detail(own, other, keep(face.features), face.features, face.landmarks).offset
        np.testing.assert_array_equal(blended[190:, :10], other.offset[190:, :10])
        opening = face.features.eyes > 0.99
        np.testing.assert_allclose(blended[opening], own.offset[opening], atol=0.05)

    def test_broad_differences_are_the_references(self, face):
        """A constant difference, as of a dark lipstick, is the reference's even where fine detail is kept."""
        own, other = (DetailMap(np.full((200, 200, 3), v, np.float32)) for v in (0.0, -0.2))
        blended = detail(own, other, keep(face.features), face.features, face.landmarks).offset
        np.testing.assert_allclose(blended[face.features.openings == 0], -0.2, atol=1e-3)

    def test_thin_lips_are_as_dark_as_the_references(self, face):
        """Lips thinner than what counts as fine get the whole darkness of the lipstick, and the skin beside none."""
        lips = face.features.lips
        own, other = DetailMap(np.zeros((200, 200, 3), np.float32)), DetailMap(-0.4 * np.dstack([lips] * 3))
        mask = keep(face.features, lips=1)
        blended = detail(own, other, mask, face.features, face.landmarks, fine=0.1).offset
        assert np.median(blended[lips > 0.9]) < -0.25
        np.testing.assert_allclose(blended[lips < 0.01], 0, atol=0.05)

    def test_equal_maps(self, face, rng):
        """Two equal maps blend to themselves, offset and gain."""
        offset, gain = (rng.random((200, 200, 3), np.float32) for _ in range(2))
        same = DetailMap(offset, gain)
        blended = detail(same, same, keep(face.features), face.features, face.landmarks)
        np.testing.assert_allclose(blended.offset, offset, atol=1e-6)
        np.testing.assert_allclose(blended.gain, gain, atol=1e-6)

    def test_a_part_that_only_one_map_has(self, face, rng):
        """A gain that the input's map does not have counts as 1 there."""
        offset, gain = (rng.random((200, 200, 3), np.float32) for _ in range(2))
        blended = detail(DetailMap(offset), DetailMap(offset, gain), face.nowhere, face.features, face.landmarks)
        np.testing.assert_array_equal(blended.gain, gain)
