"""Hair against backdrop and skin, on rows of samples."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import BACKDROP, HAIR, portrait
from stages import masks_of

from graphface.nodes.masks.density import density_model
from graphface.nodes.masks.hair_detector import Evidence, detect_hair, evidence_of
from graphface.nodes.masks.layout import layout_of
from graphface.nodes.masks.window import window_about


class TestDetectHair:
    def detected(self, rng, *parts, model="parzen", log_odds=0.0):
        """The detection on a row of (color, number, top, beside) without skin."""
        values = np.concatenate([rng.normal(color, 0.02, (count, 3)) for color, count, _, _ in parts])
        top, beside = (np.concatenate([np.full(p[1], p[k], np.float32) for p in parts]) for k in (2, 3))
        evidence = Evidence(top, beside, np.ones(len(top), np.float32), np.full(len(top), log_odds, np.float32))
        no_skin = np.full(len(top), -1e3, np.float32)
        density = density_model(values.astype(np.float32)[None], model, 4)
        return detect_hair(density, evidence, no_skin, margin=2.0, rounds=3, pseudo_count=10.0)

    @pytest.mark.parametrize("model", ["parzen", "mixture"])
    @pytest.mark.parametrize("weight", [0.5, 1.0])
    def test_share(self, rng, model, weight):
        """Half of the top is hair, whatever the weight of a pixel is."""
        parts = (BACKDROP, 400, 0, 1), (HAIR, 200, weight, 0), (BACKDROP, 200, weight, 0)
        assert self.detected(rng, *parts, model=model).share == pytest.approx(0.5, abs=0.1)

    def test_the_rim_counts_little(self, rng):
        """Backdrop at the rim of the head lowers the share of hair by its weight, not by its number."""
        parts = (BACKDROP, 400, 0, 1), (HAIR, 200, 1, 0), (BACKDROP, 200, 0.05, 0)
        assert self.detected(rng, *parts).share > 0.9

    def test_the_prior_decides_between_equals(self, rng):
        """One color on top and beside is hair with the prior odds for it, and backdrop without."""
        parts = (HAIR, 200, 1, 0), (HAIR, 400, 0, 1)
        assert self.detected(rng, *parts, log_odds=5.0).share > 0.5
        assert self.detected(rng, *parts, log_odds=0.0).share < 0.3


class TestEvidenceOf:
    def test_top_and_beside(self):
        """Samples of hair lie above the eyes within the head, samples of backdrop outside of it."""
        photo, landmarks, _ = portrait()
        window = window_about(landmarks, photo.pixels.shape, 40)
        layout, normal = layout_of(landmarks, window), window.downsampled(masks_of(photo, landmarks).normal)
        evidence = evidence_of(normal, layout, np.ones(normal.size, np.float32))
        assert layout.up.reshape(-1)[evidence.top > 0].min() > 0.34
        assert not ((evidence.top > 0) & (evidence.beside > 0)).any()
        assert evidence.log_odds[evidence.top > 0.9].min() > evidence.log_odds[evidence.beside > 0].mean()
        np.testing.assert_array_equal(evidence.inside + evidence.outside, evidence.log_odds)
