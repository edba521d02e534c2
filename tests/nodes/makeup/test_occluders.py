"""Occluders: small things much darker than the face around them."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from portraits import eyes_apart

from graphface.nodes.makeup.occluders import occluders
from graphface.nodes.types import Features

SIZE = 96
NO_FEATURES = Features(*[np.zeros((SIZE, SIZE), np.float32)] * 8)


def skin():
    """The intensity of even skin."""
    return np.full((SIZE, SIZE), 0.6, np.float32)


class TestOccluders:
    def test_a_rim_is_found(self):
        """A thin dark bar, as of glasses, is an occluder, and the skin beside it is not."""
        shading = skin()
        shading[46:50] = 0.05
        found = occluders(shading, NO_FEATURES, eyes_apart(64))
        assert found[47:49].min() > 0.9
        assert found[:40].max() == 0

    def test_a_shadow_is_not(self):
        """Half of the face in shade is skin all the same."""
        shading = skin()
        shading[:, 48:] = 0.2
        assert occluders(shading, NO_FEATURES, eyes_apart(64))[:, 60:].max() == 0

    def test_brows_are_left_out(self):
        """What the mask of the brows covers is dark by nature."""
        shading = skin()
        shading[46:50] = 0.05
        brows = Features(**{**vars(NO_FEATURES), "brows": np.ones((SIZE, SIZE), np.float32)})
        assert occluders(shading, brows, eyes_apart(64)).max() == 0

    @settings(max_examples=25, deadline=None)
    @given(shading=arrays(np.float32, (9, 7), elements=st.floats(0, 10, width=32)), apart=st.floats(0, 300))
    def test_a_mask(self, shading, apart):
        """Between 0 and 1, also for a black picture and a face of no size."""
        found = occluders(shading, Features(*[np.zeros((9, 7), np.float32)] * 8), eyes_apart(apart))
        assert found.min() >= 0
        assert found.max() <= 1
