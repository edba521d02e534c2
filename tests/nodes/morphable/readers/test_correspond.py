"""FaceMesh's points on other models."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphface.nodes.morphable.builtin import builtin_model
from graphface.nodes.morphable.readers.correspond import facemesh_on


class TestFacemeshOn:
    def test_of_the_builtin_model(self):
        """On the built-in model itself nearly every point is found near its own vertex."""
        model = builtin_model()
        alone = replace(model, landmarks={"ibug68": model.landmarks["ibug68"]})
        found = facemesh_on(alone)
        known = found >= 0
        assert known.mean() > 0.95
        away = model.mean[found[known]] - model.mean[model.landmarks["facemesh468"][known]]
        assert np.linalg.norm(away, axis=1).mean() < 0.02
