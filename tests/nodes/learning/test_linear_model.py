"""A linear face model, learned from faces of a known one."""

from __future__ import annotations

import numpy as np
import pytest
from faces import rotation_of

from graphface import UsageError
from graphface.nodes.learning.linear_model import learn_model
from graphface.nodes.morphable.topology import facemesh_topology


def faces_of(rng, count, directions, spread=1.0):
    """Faces that vary in the given symmetric directions, posed and scaled at random."""
    mean = facemesh_topology().mean.astype(float)
    made = []
    for _ in range(count):
        shape = mean + np.tensordot(rng.normal(scale=spread, size=len(directions)), directions, axes=1)
        rotation = rotation_of(*rng.uniform(-15, 15, size=3))
        made.append(rng.uniform(50, 300) * shape @ rotation.T + rng.normal(size=3) * 100)
    return np.stack(made)


@pytest.fixture
def directions(rng):
    """Two symmetric directions: longer, and deeper."""
    mean = facemesh_topology().mean.astype(float)
    return np.stack([mean * (0, 0.05, 0), mean * (0, 0, 0.08)])


class TestLearnModel:
    def test_recovers_the_directions(self, rng, directions):
        """The variation among people becomes identity, that within people expression."""
        portraits = faces_of(rng, 60, directions[:1])
        people = np.concatenate([faces_of(rng, 5, directions[1:]) for _ in range(8)])
        names = [f"p{k // 5}" for k in range(40)]
        model, figures = learn_model("toy", portraits, people, names, identity=1, expression=1)
        assert figures.left < 0.5
        assert figures.people == 8
        ours = model.expression.directions[0].ravel()
        theirs = directions[1] - directions[1].mean(axis=0)
        cosine = ours @ theirs.ravel() / np.linalg.norm(ours) / np.linalg.norm(theirs)
        assert abs(cosine) > 0.9

    def test_the_model_is_symmetric(self, rng, directions):
        """Asymmetric faces give a symmetric mean."""
        portraits = faces_of(rng, 30, directions) + rng.normal(scale=0.5, size=(30, 468, 3))
        model, _ = learn_model("toy", portraits, np.zeros((0, 468, 3)), [], identity=2, expression=0)
        mirrored = model.mean[facemesh_topology().mirror] * (-1, 1, 1)
        np.testing.assert_allclose(mirrored, model.mean, atol=1e-3)

    def test_too_few_faces_is_an_error(self, rng, directions):
        """Components need faces; the message says how many."""
        with pytest.raises(UsageError, match="at least 20"):
            learn_model("toy", faces_of(rng, 8, directions), np.zeros((0, 468, 3)), [], identity=10, expression=0)
        with pytest.raises(UsageError, match="--people"):
            learn_model("toy", faces_of(rng, 8, directions), np.zeros((0, 468, 3)), [], identity=2, expression=2)
