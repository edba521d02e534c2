"""From seeds to labels: hair detector and classifiers, on a head whose labels are known."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import BACKDROP, HAIR, SKIN, portrait, surface_of

from graphface.nodes.masks.classify import classify
from graphface.nodes.masks.connected import apart
from graphface.nodes.masks.features import pixel_features
from graphface.nodes.masks.geometric import geometric
from graphface.nodes.masks.hair import Places, detector, hair, shiny, skin_weights
from graphface.nodes.masks.likeness import likeness_of
from graphface.testing import check_node


def stages(photo, landmarks, **settings):
    masks = geometric(photo, landmarks, surface_of(landmarks, photo.pixels.shape[:2]))
    seen = pixel_features(photo, landmarks, **settings)
    return seen, masks, hair(seen, masks, landmarks)


def overlap(mask, truth):
    return (mask & truth).sum() / (mask | truth).sum()


def likeliest(labels):
    return np.stack([labels.face, labels.hair, labels.background]).argmax(axis=0)


class TestHair:
    @pytest.mark.parametrize("color", [HAIR, (0.85, 0.75, 0.45), (0.9, 0.9, 0.92), (0.5, 0.2, 0.1)])
    def test_found_by_color(self, color):
        """Dark, fair, white and red hair on top of the head is found."""
        photo, landmarks, labels = portrait(hair=color)
        found = stages(photo, landmarks)[2]
        assert overlap(found.mask > 0.5, (labels == 1)) > 0.8

    def test_response_reaches_beyond_the_mask(self):
        """The mask is the response within the normal mask."""
        photo, landmarks, _ = portrait()
        _, masks, found = stages(photo, landmarks)
        np.testing.assert_array_equal(found.mask, found.response * masks.normal)

    @pytest.mark.parametrize("color", [SKIN, tuple(min(1.0, c + 0.12) for c in SKIN)])
    def test_bald(self, color):
        """A scalp of the face's color, or lighter by a shine, is no hair."""
        photo, landmarks, _ = portrait(hair=color)
        assert (stages(photo, landmarks)[2].mask > 0.5).mean() < 0.002

    def test_backdrop_around_a_small_skull(self):
        """Backdrop that the head's solids overshoot is no hair."""
        import cv2

        photo, landmarks, labels = portrait(hair=SKIN)
        pixels = photo.pixels.copy()
        shrunk = cv2.erode(np.uint8(labels == 1) | np.uint8(labels == 0), np.ones((3, 3), np.uint8), iterations=5)
        pixels[(labels == 1) & (shrunk == 0)] = BACKDROP
        assert (stages(photo.with_pixels(pixels), landmarks)[2].mask > 0.5).mean() < 0.002

    def test_same_color_all_about(self):
        """Where the top looks just like what is beside, hair is never sure."""
        photo, landmarks, _ = portrait(hair=BACKDROP)
        assert stages(photo, landmarks)[2].response.max() < 0.8

    def test_node(self):
        """It keeps an operator's promises."""
        photo, landmarks, _ = portrait(120)
        seen, masks, _ = stages(photo, landmarks)
        check_node(hair, seen, masks, landmarks)


class TestSkin:
    def test_what_is_no_skin_teaches_little(self, rng):
        """A tenth of the samples, dark as a beard, weighs next to nothing."""
        values = rng.normal(SKIN, 0.02, (20, 10, 3)).astype(np.float32)
        values[:2] = HAIR
        weights = skin_weights(values, np.ones((20, 10), bool)).reshape(20, 10)
        assert weights[:2].max() < 0.05 < 0.5 < weights[2:].mean()

    def test_shine(self, rng):
        """What is lighter than the skin shines; the skin itself, darker things and other hues do not."""
        values = rng.normal((0.6, 0.2, 0.2), 0.01, (20, 10, 3)).astype(np.float32)
        weights = skin_weights(values, np.ones((20, 10), bool))
        values[0, :4] = (0.8, 0.2, 0.2), (0.6, 0.2, 0.2), (0.3, 0.2, 0.2), (0.8, -0.4, 0.2)
        found = shiny(values, weights)[:4]
        assert found[0] > 0.8
        assert found[1:].max() < 0.05

    def test_nothing_shines_without_skin(self):
        """Where no pixel is skin there is nothing to be lighter than."""
        assert shiny(np.ones((2, 3, 3), np.float32), np.zeros(6, np.float32)).max() == 0


class TestDetector:
    def learnt(self, rng, *parts, model="parzen", odds=0.0):
        """The detector on a row of (color, number, top, beside) without skin."""
        values = np.concatenate([rng.normal(color, 0.02, (count, 3)) for color, count, _, _ in parts]).astype(
            np.float32
        )
        top, beside = (np.concatenate([np.full(p[1], p[k], np.float32) for p in parts]) for k in (2, 3))
        places = Places(top, beside, np.ones(len(top), np.float32), np.full(len(top), odds, np.float32))
        no_skin = np.full(len(top), -1e3, np.float32)
        likeness = likeness_of(values[None], model, 4)
        return detector(likeness, places, no_skin, margin=2.0, rounds=3, doubt=10.0)

    @pytest.mark.parametrize("model", ["parzen", "mixture"])
    @pytest.mark.parametrize("weight", [0.5, 1.0])
    def test_share(self, rng, model, weight):
        """Half of the top is hair, however much a pixel says."""
        parts = (BACKDROP, 400, 0, 1), (HAIR, 200, weight, 0), (BACKDROP, 200, weight, 0)
        assert self.learnt(rng, *parts, model=model).share == pytest.approx(0.5, abs=0.1)

    def test_rim_counts_little(self, rng):
        """Backdrop at the rim of the head lowers the share of hair by its weight, not by its number."""
        parts = (BACKDROP, 400, 0, 1), (HAIR, 200, 1, 0), (BACKDROP, 200, 0.05, 0)
        assert self.learnt(rng, *parts).share > 0.9

    def test_place_decides_between_likes(self, rng):
        """One color on top and beside is hair where place says so, and backdrop where it does not."""
        parts = (HAIR, 200, 1, 0), (HAIR, 400, 0, 1)
        assert self.learnt(rng, *parts, odds=5.0).share > 0.5
        assert self.learnt(rng, *parts, odds=0.0).share < 0.3


class TestApart:
    def test_what_hangs_on_the_root_stays(self):
        """A lock that touches the root is not apart, one across a gap of half a unit is."""
        belief = np.zeros((60, 90), np.float32)
        belief[20:40, 5:50] = belief[20:40, 65:85] = 1
        root = np.zeros(belief.shape, bool)
        root[20:40, 5:10] = True
        found = apart(belief, root, 30.0)
        assert found[30, [8, 28, 40]].max() == 0
        assert found[30, 75] == 1

    def test_moves_little_with_belief(self, rng):
        """A hundredth less belief everywhere changes no pixel by more than a few hundredths."""
        belief = np.kron(rng.uniform(0.2, 1, (6, 9)), np.ones((10, 10))).astype(np.float32)
        root = np.zeros(belief.shape, bool)
        root[:10, :10] = True
        assert np.abs(apart(belief, root, 30.0) - apart(belief - 0.01, root, 30.0)).max() < 0.25

    def test_toll_cuts(self):
        """What hangs on the root only by way of a toll is apart; without the toll it is not."""
        belief = np.ones((10, 80), np.float32)
        root = np.zeros(belief.shape, bool)
        root[:, :10] = True
        toll = np.zeros(belief.shape, np.float32)
        toll[:, 30:50] = 2
        assert apart(belief, root, 20.0).max() == 0
        found = apart(belief, root, 20.0, toll)
        assert found[:, :25].max() == 0
        assert found[:, 55:].min() == 1


class TestClassify:
    @pytest.mark.parametrize("smoothing", ["none", "guided", "mean_field"])
    def test_all_three_labels(self, smoothing):
        """Face with neck and ears, hair and background overlap the truth, with every smoothing."""
        photo, landmarks, labels = portrait()
        found = likeliest(classify(*stages(photo, landmarks), landmarks, photo, smoothing=smoothing))
        assert [overlap(found == k, labels == k) > least for k, least in enumerate((0.9, 0.85, 0.93))] == [True] * 3

    @pytest.mark.parametrize("settings", [{"space": "rgb"}, {"space": "hsv"}, {"kind": "color"}, {"resolution": 20}])
    def test_feature_swaps(self, settings):
        """Every color space, feature set and resolution does the job on an easy head."""
        photo, landmarks, labels = portrait()
        found = likeliest(classify(*stages(photo, landmarks, **settings), landmarks, photo))
        assert overlap(found == 1, labels == 1) > 0.75

    def test_model_swap(self):
        """Mixtures of Gaussians do the job as densities do."""
        photo, landmarks, labels = portrait()
        seen, masks, _ = stages(photo, landmarks)
        found = hair(seen, masks, landmarks, model="mixture")
        shown = likeliest(classify(seen, masks, found, landmarks, photo, model="mixture"))
        assert overlap(shown == 1, labels == 1) > 0.8

    def test_partition(self):
        """Labels lie in [0, 1] and sum to 1."""
        photo, landmarks, _ = portrait()
        labels = classify(*stages(photo, landmarks), landmarks, photo)
        total = labels.face + labels.hair + labels.background
        np.testing.assert_allclose(total, 1, atol=1e-5)
        assert min(m.min() for m in (labels.face, labels.hair, labels.background)) >= 0

    def test_conservative_mask_is_face(self):
        """What is surely face is never called anything else."""
        photo, landmarks, _ = portrait()
        seen, masks, found = stages(photo, landmarks)
        labels = classify(seen, masks, found, landmarks, photo)
        assert labels.face[masks.conservative > 0].min() > 0.5

    def test_dark_suit_is_no_hair(self):
        """Clothes of the hair's color below the neck are background."""
        photo, landmarks, labels = portrait()
        pixels = photo.pixels.copy()
        pixels[int(0.85 * len(pixels)) :] = HAIR
        found = likeliest(classify(*stages(photo.with_pixels(pixels), landmarks), landmarks, photo))
        assert (found[int(0.88 * len(pixels)) :] == 1).mean() < 0.05
        assert overlap(found == 1, labels == 1) > 0.8

    def test_node(self):
        """It keeps an operator's promises."""
        photo, landmarks, _ = portrait(120)
        check_node(classify, *stages(photo, landmarks), landmarks, photo)
