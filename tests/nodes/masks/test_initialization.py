"""The initial state of the classifiers."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from portraits import portrait

from graphface.nodes.masks.features import features
from graphface.nodes.masks.initialization import initial_from_geometry, initial_from_segmentation
from graphface.nodes.masks.layout import layout_of
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, FACE, HAIR
from graphface.nodes.masks.window import window_about

PHOTO, LANDMARKS, _ = portrait(120)
WINDOW = window_about(LANDMARKS, (120, 120), 20)
LAYOUT = layout_of(LANDMARKS, WINDOW)
SHAPE = LAYOUT.outline.shape
NOWHERE, EVERYWHERE = np.zeros(SHAPE, bool), np.ones(SHAPE, np.float32)


def constant(*probabilities):
    return [np.full(SHAPE, probability, np.float32) for probability in probabilities]


class TestInitialFromGeometry:
    def initial(self, hair):
        values = features(WINDOW.downsampled(PHOTO.pixels))
        aggressive = np.float32(LAYOUT.head < 0.3)
        return initial_from_geometry(values, LAYOUT, LAYOUT.outline < -0.1, aggressive, hair, 20.0, 1.0)

    def test_seeds(self):
        """Face inside, background outside, hair where it was found on the head; between them nothing."""
        weights = self.initial(EVERYWHERE * (LAYOUT.up > 0.5)).probabilities
        assert (weights[LAYOUT.outline < -0.1][:, FACE] == 1).all()
        assert (weights[(LAYOUT.head < -0.05) & (LAYOUT.up > 0.6) & (LAYOUT.outline > 0)][:, HAIR] == 1).all()
        assert weights[0, 0, HAIR] == 0
        assert not weights[(LAYOUT.outline > 0.1) & (LAYOUT.head < 0.2) & (np.abs(LAYOUT.up) < 0.3)].any()

    def test_no_hair_found(self):
        """Where the detector found no hair, the score of hair is lower everywhere."""
        none, some = self.initial(0 * EVERYWHERE), self.initial(EVERYWHERE)
        np.testing.assert_allclose(none.log_prior[..., HAIR], some.log_prior[..., HAIR] - 6, atol=1e-5)


class TestInitialFromSegmentation:
    def test_backdrop_and_clothes_share(self):
        """The segmentation's background is backdrop above and clothes below."""
        initial = initial_from_segmentation(
            *constant(0, 0), LAYOUT, NOWHERE, EVERYWHERE, np.zeros(SHAPE, np.float32), 1.0
        )
        above, below = initial.probabilities[0, 0], initial.probabilities[-1, SHAPE[1] // 2]
        assert above[BACKDROP] > 2 * above[CLOTHES]
        assert below[CLOTHES] > 2 * below[BACKDROP]
        assert initial.probabilities[..., BACKDROP:].sum(axis=2).min() > 0.9

    def test_the_conservative_mask_is_face(self):
        """What is surely face is a sample of face, whatever the segmentation says."""
        sure = LAYOUT.outline < -0.1
        initial = initial_from_segmentation(*constant(0, 1), LAYOUT, sure, EVERYWHERE, np.ones(SHAPE, np.float32), 1.0)
        assert (initial.probabilities[sure][:, FACE] == 1).all()

    def test_beyond_the_aggressive_mask(self):
        """What cannot be face is no sample of it, however certain the segmentation is."""
        initial = initial_from_segmentation(*constant(1, 0), LAYOUT, NOWHERE, 0 * EVERYWHERE, 0 * EVERYWHERE, 1.0)
        assert initial.probabilities[..., FACE].max() == 0

    def test_certain_hair(self):
        """Certain hair replaces the segmentation's; the other classes share the rest in proportion."""
        certain = np.full(SHAPE, 0.25, np.float32)
        initial = initial_from_segmentation(*constant(0.5, 0), LAYOUT, NOWHERE, EVERYWHERE, certain, 1.0)
        found = initial.probabilities
        np.testing.assert_allclose(found[..., HAIR], 0.25)
        np.testing.assert_allclose(found[..., FACE] + found[..., BACKDROP:].sum(axis=2), 0.75, atol=1e-3)

    @given(st.tuples(st.floats(0, 1), st.floats(0, 1)), st.floats(0, 1), st.floats(0, 4))
    def test_any_segmentation(self, probabilities, hair, weight):
        """Probabilities of 0 and 1, any hair and any weight: finite scores, weights that sum to 1 at most."""
        certain = np.full(SHAPE, hair, np.float32)
        initial = initial_from_segmentation(*constant(*probabilities), LAYOUT, NOWHERE, EVERYWHERE, certain, weight)
        assert np.isfinite(initial.log_prior).all()
        assert initial.probabilities.min() >= 0
        assert initial.probabilities.sum(axis=2).max() <= 1 + 1e-4
