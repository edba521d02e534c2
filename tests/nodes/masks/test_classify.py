"""From seeds or a prior segmentation to labels, on a head whose labels are known."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import HAIR, portrait
from stages import assert_partition, certain, cued, detected, most_likely, overlap, overlaps, parameters_of

from graphface import GraphfaceWarning, load
from graphface.nodes.masks.classify import classify
from graphface.nodes.masks.hair import hair
from graphface.nodes.types import Segmentation
from graphface.testing import check_node


class TestFromGeometry:
    @pytest.mark.parametrize("smoothing", ["none", "guided", "mean_field"])
    def test_all_three_labels(self, smoothing):
        """Face with neck and ears, hair and background overlap the truth, with every smoothing."""
        photo, landmarks, labels = portrait()
        found = classify(*detected(photo, landmarks), landmarks, photo, smoothing=smoothing)
        assert (np.array(overlaps(found, labels)) > (0.9, 0.85, 0.93)).all()

    @pytest.mark.parametrize("settings", [{"space": "rgb"}, {"space": "hsv"}, {"kind": "color"}, {"resolution": 20}])
    def test_feature_swaps(self, settings):
        """Every color space, feature set and resolution finds the hair of an easy head."""
        photo, landmarks, labels = portrait()
        found = classify(*detected(photo, landmarks, **settings), landmarks, photo)
        assert overlaps(found, labels)[1] > 0.75

    def test_model_swap(self):
        """Mixtures of Gaussians find the hair, as kernel densities do."""
        photo, landmarks, labels = portrait()
        features, masks, _ = detected(photo, landmarks)
        seeds = hair(features, masks, landmarks, model="mixture")
        assert overlaps(classify(features, masks, seeds, landmarks, photo, model="mixture"), labels)[1] > 0.8

    def test_former_names(self):
        """Parameters keep their former names in graphs, with a warning."""
        with pytest.warns(GraphfaceWarning, match="likelihood"):
            graph = load("segment", set={"classes.evidence": 2.0})
        assert parameters_of(graph, "classes")["likelihood"] == 2.0

    def test_partition(self):
        """Labels lie in [0, 1] and sum to 1."""
        photo, landmarks, _ = portrait()
        assert_partition(classify(*detected(photo, landmarks), landmarks, photo))

    def test_conservative_mask_is_face(self):
        """What is surely face has no other label."""
        photo, landmarks, _ = portrait()
        features, masks, seeds = detected(photo, landmarks)
        labels = classify(features, masks, seeds, landmarks, photo)
        assert labels.face[masks.conservative > 0].min() > 0.5

    def test_dark_suit_is_no_hair(self):
        """Clothes of the hair's color below the neck are background."""
        photo, landmarks, labels = portrait()
        pixels = photo.pixels.copy()
        pixels[int(0.85 * len(pixels)) :] = HAIR
        found = most_likely(classify(*detected(photo.with_pixels(pixels), landmarks), landmarks, photo))
        assert (found[int(0.88 * len(pixels)) :] == 1).mean() < 0.05
        assert overlap(found == 1, labels == 1) > 0.8

    def test_node(self):
        """It keeps an operator's promises."""
        photo, landmarks, _ = portrait(120)
        check_node(classify, *detected(photo, landmarks), landmarks, photo)


class TestFromAPriorSegmentation:
    @pytest.mark.parametrize("model", ["parzen", "mixture"])
    def test_right_labels_stay_right(self, model):
        """Labels that are right stay so, up to edges as wide as the smoothing."""
        photo, landmarks, labels = portrait()
        cue = certain(labels)
        found = classify(*cued(photo, landmarks, cue), landmarks, photo, cue, model=model)
        assert min(overlaps(found, labels)) > 0.9

    def test_coarse_labels_are_sharpened(self):
        """Blurred, displaced labels come nearer to the truth by the photo's own colors."""
        import cv2

        photo, landmarks, labels = portrait()
        moved = [np.roll(cv2.GaussianBlur(np.float32(labels == k), (0, 0), 6), 4, axis=1) for k in range(3)]
        cue = Segmentation(*(m / sum(moved) for m in moved))
        found = classify(*cued(photo, landmarks, cue), landmarks, photo, cue)
        assert np.mean(overlaps(found, labels)) > np.mean(overlaps(cue, labels)) + 0.03

    def test_node(self):
        """It keeps an operator's promises with a prior segmentation, too."""
        photo, landmarks, labels = portrait(120)
        cue = certain(labels)
        check_node(classify, *cued(photo, landmarks, cue), landmarks, photo, cue)
