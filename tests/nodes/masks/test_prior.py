"""The prior over classes."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from portraits import landmarks_at

from graphface.nodes.masks.layout import layout_of
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, FACE, HAIR, log_prior
from graphface.nodes.masks.window import window_about


def prior_at(x, y, interocular, roll=0.0, side=200):
    landmarks = landmarks_at(x, y, interocular, roll)
    layout = layout_of(landmarks, window_about(landmarks, (side, side), 40))
    return layout, log_prior(layout)


class TestLogPrior:
    def test_most_likely_classes(self):
        """Face inside the landmarks, hair on the crown, backdrop in the upper corner, clothes at the lower edge."""
        _, prior = prior_at(100, 90, 40.0)
        likely = prior.argmax(axis=2)
        assert likely[90, 100] == FACE
        assert likely[48, 100] == HAIR
        assert likely[3, 3] == BACKDROP
        assert likely[-1, 100] == CLOTHES

    @given(st.floats(-300, 300), st.floats(-300, 300), st.floats(0.5, 300), st.floats(-3.1, 3.1))
    def test_is_a_distribution(self, x, y, interocular, roll):
        """Wherever the face is, probabilities of the four classes sum to 1."""
        _, prior = prior_at(x, y, interocular, roll, side=40)
        np.testing.assert_allclose(np.exp(prior).sum(axis=2), 1, atol=1e-4)
