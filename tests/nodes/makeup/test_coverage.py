"""How strongly each pixel is made up."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface.nodes.makeup.coverage import coverage
from graphface.nodes.types import Features


class TestCoverage:
    def test_parts_have_their_own_strength(self, face):
        """Lips alone: nothing else is covered."""
        covered = coverage(face.everywhere, face.features, lids=0, brows=0, cheeks=0, base=0)
        assert covered[face.features.lips > 0.95].min() > 0.9
        assert covered[190:, :10].max() == 0

    def test_a_users_strengths(self, face):
        """A user's mask is multiplied on top."""
        half = np.full((200, 200), 0.5, np.float32)
        np.testing.assert_allclose(coverage(face.everywhere, face.features, half), 0.5)

    @settings(max_examples=20, deadline=None)
    @given(strength=st.floats(0, 1), base=st.floats(0, 1))
    def test_never_more_than_the_skin(self, strength, base):
        """Coverage lies between 0 and the skin mask."""
        found = Features(*[np.zeros((4, 4), np.float32)] * 8)
        mask = np.linspace(0, 1, 16, dtype=np.float32).reshape(4, 4)
        covered = coverage(mask, found, strength=strength, base=base)
        assert covered.min() >= 0
        assert (covered <= mask + 1e-6).all()
