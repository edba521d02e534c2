"""Labels that are connected to the head."""

from __future__ import annotations

import numpy as np
from portraits import portrait

from graphface.nodes.masks.connected import connected, disconnected, seeds_of
from graphface.nodes.masks.layout import layout_of
from graphface.nodes.masks.prior import BACKDROP, HAIR
from graphface.nodes.masks.window import window_about


class TestDisconnected:
    def test_a_gap(self):
        """A lock that touches the seeds is connected, one across a gap of half a unit is not."""
        probability = np.zeros((60, 90), np.float32)
        probability[20:40, 5:50] = probability[20:40, 65:85] = 1
        seeds = np.zeros(probability.shape, bool)
        seeds[20:40, 5:10] = True
        found = disconnected(probability, seeds, 30.0)
        assert found[30, [8, 28, 40]].max() == 0
        assert found[30, 75] == 1

    def test_changes_little_with_probability(self, rng):
        """A hundredth less probability everywhere changes no pixel by more than a quarter."""
        probability = np.kron(rng.uniform(0.2, 1, (6, 9)), np.ones((10, 10))).astype(np.float32)
        seeds = np.zeros(probability.shape, bool)
        seeds[:10, :10] = True
        before, after = (disconnected(p, seeds, 30.0) for p in (probability, probability - 0.01))
        assert np.abs(before - after).max() < 0.25

    def test_extra_cost_cuts(self):
        """A part that only a costly path joins to the seeds is not connected."""
        probability = np.ones((10, 80), np.float32)
        seeds = np.zeros(probability.shape, bool)
        seeds[:, :10] = True
        extra_cost = np.zeros(probability.shape, np.float32)
        extra_cost[:, 30:50] = 2
        assert disconnected(probability, seeds, 20.0).max() == 0
        found = disconnected(probability, seeds, 20.0, extra_cost)
        assert found[:, :25].max() == 0
        assert found[:, 55:].min() == 1


class TestConnected:
    def given(self):
        """A layout, and probabilities of hair on the head and in a corner of the picture."""
        photo, landmarks, _ = portrait()
        window = window_about(landmarks, photo.pixels.shape, 40)
        layout = layout_of(landmarks, window)
        probabilities = np.zeros((*layout.head.shape, 4), np.float32)
        corner = np.zeros(layout.head.shape, bool)
        corner[:15, :15] = True
        probabilities[..., HAIR] = corner | seeds_of(layout).hair
        probabilities[..., BACKDROP] = 1 - probabilities[..., HAIR]
        return layout, probabilities, corner

    def test_hair_of_somebody_else_is_backdrop(self):
        """Hair in the corner of the picture becomes backdrop, hair on the head stays."""
        layout, probabilities, corner = self.given()
        found = connected(probabilities, layout, 40.0, None)
        assert found[corner][:, HAIR].max() < 0.01
        assert found[corner][:, BACKDROP].min() > 0.99
        assert found[seeds_of(layout).hair][:, HAIR].min() > 0.99
        np.testing.assert_allclose(found.sum(axis=2), 1, atol=1e-6)

    def test_a_prior_segmentation_keeps_it(self):
        """Where the prior segmentation is certain of hair, hair needs no connection."""
        layout, probabilities, corner = self.given()
        prior = np.zeros_like(layout.head), corner.astype(np.float32)
        assert connected(probabilities, layout, 40.0, prior)[corner][:, HAIR].min() > 0.99
