"""Random lights."""

from __future__ import annotations

import json

import numpy as np
import pytest

from graphface.nodes.learning.rendering.lights import random_lights


class TestRandomLights:
    @pytest.mark.parametrize("seed", range(40))
    def test_lit_from_the_front(self, seed):
        """Every lamp stands before the face or beside it, and gives about the irradiance that was meant."""
        lights = random_lights(np.random.default_rng(seed))
        assert 1 <= len(lights.lamps) <= 2
        for lamp in lights.lamps:
            assert np.linalg.norm(lamp.direction) == pytest.approx(1)
            assert lamp.direction[2] > -1e-6
            assert 0.05 < np.mean(lamp.radiance) * (2 * lamp.half_size / lamp.distance) ** 2 < 2
        assert min(lights.ambient) > 0

    def test_as_json(self):
        """What is kept of them can be written and read."""
        lights = random_lights(np.random.default_rng(0))
        assert json.loads(json.dumps(lights.as_json()))["kind"] == lights.kind

    def test_every_kind(self):
        """Flash, window, side, hard, two lamps and even light all occur."""
        assert len({random_lights(np.random.default_rng(k)).kind for k in range(100)}) == 6
