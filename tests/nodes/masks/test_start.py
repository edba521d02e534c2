"""What the classifiers start from."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from portraits import portrait, surface_of

from graphface.nodes.masks.classify import classify
from graphface.nodes.masks.cued_hair import cued_hair
from graphface.nodes.masks.features import pixel_features
from graphface.nodes.masks.geometric import geometric
from graphface.nodes.masks.hair import Hair
from graphface.nodes.masks.prior import BACKDROP, CLOTHES, FACE, HAIR, layout_of
from graphface.nodes.masks.start import start_from_cue
from graphface.nodes.masks.window import window_about
from graphface.nodes.types import Segmentation
from graphface.testing import check_node

LANDMARKS = portrait(120)[1]
LAYOUT = layout_of(LANDMARKS, window_about(LANDMARKS, (120, 120), 20))
SHAPE = LAYOUT.outline.shape
NOWHERE, EVERYWHERE = np.zeros(SHAPE, bool), np.ones(SHAPE, np.float32)


def constant(*chances):
    return [np.full(SHAPE, chance, np.float32) for chance in chances]


def told(labels):
    """Labels H x W of numbers as a cue that is sure of them."""
    return Segmentation(*(np.float32(labels == k) for k in range(3)))


class TestStartFromCue:
    def test_backdrop_and_clothes_share(self):
        """What the cue gives to the background is backdrop above and clothes below."""
        start = start_from_cue(*constant(0, 0), LAYOUT, NOWHERE, EVERYWHERE, np.zeros(SHAPE, np.float32), 1.0)
        assert start.belief[0, 0, BACKDROP] > 2 * start.belief[0, 0, CLOTHES]
        assert start.belief[-1, SHAPE[1] // 2, CLOTHES] > 2 * start.belief[-1, SHAPE[1] // 2, BACKDROP]
        assert start.belief[..., BACKDROP:].sum(axis=2).min() > 0.9

    def test_the_sure_mask_is_face(self):
        """Whatever the cue says, what is surely face teaches face."""
        sure = LAYOUT.outline < -0.1
        start = start_from_cue(*constant(0, 1), LAYOUT, sure, EVERYWHERE, np.ones(SHAPE, np.float32), 1.0)
        assert (start.belief[sure][:, FACE] == 1).all()

    def test_beyond_the_aggressive_mask(self):
        """What cannot be face teaches no face at first, however sure the cue is of it."""
        start = start_from_cue(*constant(1, 0), LAYOUT, NOWHERE, 0 * EVERYWHERE, 0 * EVERYWHERE, 1.0)
        assert start.belief[..., FACE].max() == 0

    def test_hair_that_somebody_says(self):
        """Given hair takes its share of first belief, and what it leaves is shared as the cue has it."""
        response = np.full(SHAPE, 0.25, np.float32)
        belief = start_from_cue(*constant(0.5, 0), LAYOUT, NOWHERE, EVERYWHERE, response, 1.0).belief
        np.testing.assert_allclose(belief[..., HAIR], 0.25)
        np.testing.assert_allclose(belief[..., FACE] + belief[..., BACKDROP:].sum(axis=2), 0.75, atol=1e-3)

    @given(st.tuples(st.floats(0, 1), st.floats(0, 1)), st.floats(0, 1), st.floats(0, 4))
    def test_any_cue(self, chances, response, weight):
        """Cues of 0 and 1, any hair and any weight: finite scores, belief that sums to 1 at most."""
        start = start_from_cue(
            *constant(*chances), LAYOUT, NOWHERE, EVERYWHERE, np.full(SHAPE, response, np.float32), weight
        )
        assert np.isfinite(start.expected).all()
        assert start.belief.min() >= 0
        assert start.belief.sum(axis=2).max() <= 1 + 1e-4


class TestClassifyByACue:
    @pytest.mark.parametrize("model", ["parzen", "mixture"])
    def test_a_right_cue_stays_right(self, model):
        """Labels that are right stay so, up to edges as wide as smoothing."""
        photo, landmarks, labels = portrait()
        found = classified(photo, landmarks, told(labels), model=model)
        assert min(overlaps(found, labels)) > 0.9

    def test_a_coarse_cue_is_sharpened(self):
        """A blurred, moved cue comes nearer to the truth by the photo's own colors."""
        import cv2

        photo, landmarks, labels = portrait()
        moved = [np.roll(cv2.GaussianBlur(np.float32(labels == k), (0, 0), 6), 4, axis=1) for k in range(3)]
        cue = Segmentation(*(m / sum(moved) for m in moved))
        found = classified(photo, landmarks, cue)
        assert np.mean(overlaps(found, labels)) > np.mean(overlaps(cue, labels)) + 0.03

    def test_node(self):
        """It keeps an operator's promises with a cue, too."""
        photo, landmarks, labels = portrait(120)
        masks = geometric(photo, landmarks, surface_of(landmarks, (120, 120)))
        seen, cue = pixel_features(photo, landmarks), told(labels)
        check_node(classify, seen, masks, cued_hair(cue, masks), landmarks, photo, cue)


class TestCuedHair:
    def test_the_mask_is_within_the_normal_one(self):
        """Hair beyond the head is in the response and not in the mask."""
        photo, landmarks, labels = portrait()
        masks = geometric(photo, landmarks, surface_of(landmarks, photo.pixels.shape[:2]))
        found = cued_hair(told(np.ones_like(labels)), masks)
        assert isinstance(found, Hair)
        assert (found.response == 1).all()
        np.testing.assert_array_equal(found.mask, masks.normal)


def classified(photo, landmarks, cue, **settings):
    masks = geometric(photo, landmarks, surface_of(landmarks, photo.pixels.shape[:2]))
    return classify(pixel_features(photo, landmarks), masks, cued_hair(cue, masks), landmarks, photo, cue, **settings)


def overlaps(labels, truth):
    found = np.stack([labels.face, labels.hair, labels.background]).argmax(axis=0)
    return [((found == k) & (truth == k)).sum() / ((found == k) | (truth == k)).sum() for k in range(3)]
