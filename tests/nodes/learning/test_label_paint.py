"""Make-up on training pictures."""

from __future__ import annotations

import numpy as np
import pytest
from drawn import drawn_person

from graphface.nodes.learning.label_paint import painted


class TestPainted:
    @pytest.mark.parametrize("seed", range(6))
    def test_on_the_face_alone(self, seed):
        """Paint changes colors of the face label alone, and no label."""
        own = drawn_person()
        found = painted(own, np.random.default_rng(seed))
        beyond = own.labels[..., 0] == 0
        np.testing.assert_allclose(found.pixels[beyond], own.pixels[beyond], atol=1e-5)
        assert found.labels is own.labels

    def test_shows(self):
        """Some paint is seen."""
        own = drawn_person()
        changes = [np.abs(painted(own, np.random.default_rng(seed)).pixels - own.pixels).max() for seed in range(8)]
        assert max(changes) > 0.1
