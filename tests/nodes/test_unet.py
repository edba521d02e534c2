"""The arithmetic of the small U-Net, against SciPy's."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.ndimage import correlate

from graphface.nodes.unet import convolved


class TestConvolved:
    @settings(max_examples=40)
    @given(
        st.integers(1, 9),
        st.integers(1, 9),
        st.integers(1, 4),
        st.integers(1, 4),
        st.sampled_from([1, 3, 5]),
        st.integers(0, 99),
    )
    def test_like_scipy(self, height, width, inputs, outputs, size, seed):
        """Each output is the sum of its inputs' correlations with zeros beyond the picture, plus its bias."""
        rng = np.random.default_rng(seed)
        cells = rng.normal(size=(height, width, inputs)).astype(np.float32)
        kernel = rng.normal(size=(size, size, inputs, outputs)).astype(np.float32)
        bias = rng.normal(size=outputs).astype(np.float32)
        found = convolved(cells, {"it.weight": kernel, "it.bias": bias}, "it")
        for k in range(outputs):
            expected = bias[k] + sum(
                correlate(cells[..., c], kernel[..., c, k], mode="constant") for c in range(inputs)
            )
            np.testing.assert_allclose(found[..., k], expected, atol=1e-4)

    def test_rows_in_parts(self, rng):
        """A picture of which only parts go into one product is convolved like its parts."""
        cells = rng.normal(size=(64, 64, 16)).astype(np.float32)
        weights = {
            "it.weight": rng.normal(size=(3, 3, 16, 32)).astype(np.float32),
            "it.bias": np.zeros(32, np.float32),
        }
        whole, part = convolved(cells, weights, "it"), convolved(cells[10:20], weights, "it")
        np.testing.assert_allclose(whole[11:19], part[1:9], atol=1e-4)
