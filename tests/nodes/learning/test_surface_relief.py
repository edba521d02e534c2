"""The relief of a model, learned from true normals."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from faces import landmarks_of, rotation_of
from hypothesis import given, settings
from hypothesis import strategies as st

from graphface import UsageError
from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.learning.surface_relief import Difference, learned_relief, normal_difference, with_relief
from graphface.nodes.morphable.builtin import BUILTIN
from graphface.nodes.morphable.storage import load_model, refined
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Image

COARSE = load_model(BUILTIN, refine=False)
FINE = refined(COARSE, 1)
PHOTO = Image(np.zeros((480, 640, 3), np.float32))


def bumps():
    """A relief that is broad, symmetric, and a few per cent of the eye distance high."""
    x, y = COARSE.mean[:, 0], COARSE.mean[:, 1]
    return (0.03 * np.cos(5 * x) * np.cos(4 * y)).astype(np.float32)


def measured(model, true, rotation):
    """The difference of normals between a face of the `true` model and a fit of `model`."""
    landmarks = landmarks_of(true, rotation=rotation)
    fitted, known = (morphable(landmarks, model=m, identity=0, expression=0) for m in (model, true))
    drawn, truth = rasterize(fitted, PHOTO, smoothing=0), rasterize(known, PHOTO, smoothing=0)
    return normal_difference(fitted, drawn, truth.normals, truth.coverage)


class TestLearnedRelief:
    def test_recovers_a_relief(self):
        """Most of the difference of normals is removed."""
        true = with_relief(COARSE, bumps())
        turns = [rotation_of(yaw, pitch) for yaw, pitch in ((0, 0), (20, 0), (-20, 0), (0, 12))]
        faces = [measured(FINE, refined(true, 1), turn) for turn in turns]
        better = with_relief(COARSE, learned_relief(COARSE, 1, faces, smoothness=5.0, ridge=0.01))
        before, after = (
            np.mean([np.square(measured(refined(m, 1), refined(true, 1), turn).mean).mean() for turn in turns])
            for m in (COARSE, better)
        )
        assert after < 0.4 * before

    def test_nothing_to_learn(self):
        """Equal normals displace nothing."""
        nothing = Difference(np.zeros(FINE.mean.shape), np.ones(len(FINE.mean), bool))
        np.testing.assert_allclose(learned_relief(COARSE, 1, [nothing]), 0, atol=1e-9)

    @settings(max_examples=10, deadline=None)
    @given(st.integers(0, 2**32 - 1), st.floats(0, 1))
    def test_any_differences(self, seed, share):
        """Any differences, at any number of vertices: a finite, symmetric and small displacement."""
        rng = np.random.default_rng(seed)
        wild = Difference(rng.uniform(-2, 2, FINE.mean.shape), rng.uniform(size=len(FINE.mean)) < share)
        model = with_relief(COARSE, learned_relief(COARSE, 1, [wild]))
        moved = model.mean - COARSE.mean
        assert np.isfinite(moved).all()
        assert np.abs(moved).max() < 1
        assert morphable(landmarks_of(refined(model, 1)), model=refined(model, 1)).mirror is not None

    def test_faces_of_another_mesh(self):
        """Faces of another mesh, or none, are refused."""
        with pytest.raises(UsageError, match="vertices"):
            learned_relief(COARSE, 1, [Difference(np.zeros((5, 3)), np.ones(5, bool))])
        with pytest.raises(UsageError, match="vertices"):
            learned_relief(COARSE, 1, [])

    def test_an_unfitted_mesh(self):
        """A mesh without a fit is refused."""
        mesh = morphable(landmarks_of())
        surface = rasterize(mesh, PHOTO)
        with pytest.raises(UsageError, match="without a fit"):
            normal_difference(replace(mesh, fit=None), surface, surface.normals, surface.coverage)
