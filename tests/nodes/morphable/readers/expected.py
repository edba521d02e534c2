"""What every reader promises."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.morphable.builtin import builtin_model


def agrees(model, expressions=1):
    """A model read from the face of `conftest` has its unit, triangles, landmarks and directions."""
    points = model.mean[model.landmarks["ibug68"]]
    assert np.linalg.norm(points[45] - points[36]) == pytest.approx(1, abs=1e-4)
    assert len(model.triangles) == len(builtin_model().triangles)
    assert len(model.identity) == 2
    assert len(model.expression) >= expressions
    ours = builtin_model()
    unit = np.linalg.norm(np.diff(ours.mean[ours.landmarks["ibug68"][[36, 45]]], axis=0))
    one = ours.identity.directions[1][ours.landmarks["ibug68"][17:]] / unit
    np.testing.assert_allclose(model.identity.directions[1][model.landmarks["ibug68"][17:]], one, atol=2e-3)
    assert (model.landmarks["facemesh468"] >= 0).sum() > 400
