"""ICT-FaceKit reduced to the shipped head."""

from __future__ import annotations

import numpy as np

from graphface.nodes.learning.head_model import head_model
from graphface.nodes.morphable.head_model import builtin_head


def test_the_shipped_head():
    """468 points without triangles at the end, small enough to ship, its notice beside it."""
    model = builtin_head()
    points = model.landmarks["facemesh468"]
    assert points.tolist() == list(range(len(model.mean) - 468, len(model.mean)))
    assert model.triangles.max() < points[0]
    assert len(model.triangles) < 10_000
    assert "MIT" in model.card["license"]


def test_made_from_ict_facekit(shared):
    """The command's work on the real sources gives the shipped head."""
    model = head_model(shared / "models/ict_facekit.npz", shared, identity=10, triangles=9000)
    shipped = builtin_head()
    assert model.triangles.shape == shipped.triangles.shape
    np.testing.assert_array_equal(model.triangles, shipped.triangles)
    for made, there in ((model.mean, shipped.mean), (model.identity.directions, shipped.identity.directions)):
        np.testing.assert_allclose(made, there, atol=2e-3)
