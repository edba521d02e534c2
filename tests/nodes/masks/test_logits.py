"""Probabilities and their logarithms."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from graphface.nodes.masks.logits import log_softmax, log_sum_exp, sigmoid, softmax

scores = arrays(np.float32, st.tuples(st.integers(1, 4), st.integers(1, 5)), elements=st.floats(-1e4, 1e4, width=32))


class TestSoftmax:
    @given(scores)
    def test_is_a_partition(self, x):
        """Probabilities are finite, in range and sum to 1, however large the scores are."""
        found = softmax(x)
        assert found.dtype == np.float32
        assert found.min() >= 0
        np.testing.assert_allclose(found.sum(axis=-1), 1, atol=1e-3)

    def test_of_two_is_the_sigmoid(self):
        """With two classes it is the sigmoid of the difference."""
        x = np.linspace(-20, 20, 9, dtype=np.float32)
        pairs = np.stack([x, np.zeros_like(x)], axis=1)
        np.testing.assert_allclose(softmax(pairs)[:, 0], sigmoid(x), rtol=1e-5)


class TestLogSumExp:
    @given(scores)
    def test_like_numpy(self, x):
        """As NumPy's logaddexp over the last axis, which is kept."""
        expected = np.logaddexp.reduce(x.astype(np.float64), axis=-1, keepdims=True)
        np.testing.assert_allclose(log_sum_exp(x), expected, rtol=1e-5, atol=1e-5)
        np.testing.assert_array_equal(log_softmax(x), x - log_sum_exp(x))


class TestSigmoid:
    def test_never_overflows(self):
        """Any number has a finite sigmoid in [0, 1]."""
        found = sigmoid(np.float32([-1e30, -5, 0, 5, 1e30]))
        assert found[2] == 0.5
        assert (np.diff(found) > 0).all()
        assert found[-1] == 1
