"""Running networks with OpenCV."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from graphface.nodes.landmarks.network import run_network, sigmoid
from graphface.nodes.landmarks.weights import BLAZEFACE


class TestSigmoid:
    def test_never_overflows(self):
        """Any logit has a finite sigmoid in [0, 1]."""
        found = sigmoid(np.float32([-1e30, 0, 1e30]))
        np.testing.assert_allclose(found, [0, 0.5, 1], atol=1e-6)


@pytest.mark.usefixtures("weights")
class TestRunNetwork:
    def test_outputs_by_name(self):
        """Every output of the detector, with one row for each anchor."""
        found = run_network(BLAZEFACE, np.zeros((256, 256, 3), np.float32))
        assert {name: out.shape[1] for name, out in found.items()} == {"classificators": 896, "regressors": 896}

    def test_threads(self, rng):
        """Each thread has a network of its own, with the same result."""
        pixels = rng.uniform(-1, 1, (256, 256, 3)).astype(np.float32)
        with ThreadPoolExecutor(3) as pool:
            several = list(pool.map(lambda _: run_network(BLAZEFACE, pixels)["regressors"], range(6)))
        for one in several[1:]:
            np.testing.assert_array_equal(one, several[0])
