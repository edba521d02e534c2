"""Stages of the segmentation and overlaps of labels, for the tests of masks."""

from __future__ import annotations

import numpy as np
from portraits import surface_of

from graphface.nodes.masks.cued_hair import cued_hair
from graphface.nodes.masks.features import pixel_features
from graphface.nodes.masks.geometric import geometric
from graphface.nodes.masks.hair import hair
from graphface.nodes.types import Segmentation


def masks_of(photo, landmarks):
    """Head masks of a drawn portrait."""
    return geometric(photo, landmarks, surface_of(landmarks, photo.pixels.shape[:2]))


def detected(photo, landmarks, **settings):
    """Features, head masks and hair by the detector: the first arguments of `classify`."""
    masks = masks_of(photo, landmarks)
    features = pixel_features(photo, landmarks, **settings)
    return features, masks, hair(features, masks, landmarks)


def cued(photo, landmarks, cue):
    """Features, head masks and hair of a prior segmentation."""
    masks = masks_of(photo, landmarks)
    return pixel_features(photo, landmarks), masks, cued_hair(cue, masks)


def certain(labels):
    """Label numbers H x W as a segmentation of probabilities 0 and 1."""
    return Segmentation(*(np.float32(labels == k) for k in range(3)))


def stacked(labels):
    """Face, hair and background, 3 x H x W."""
    return np.stack([labels.face, labels.hair, labels.background])


def most_likely(labels):
    """Number of the most likely label, H x W."""
    return stacked(labels).argmax(axis=0)


def overlap(mask, truth):
    """Intersection over union."""
    return (mask & truth).sum() / (mask | truth).sum()


def overlaps(labels, truth):
    """Intersection over union of each label."""
    return [overlap(most_likely(labels) == k, truth == k) for k in range(3)]


def assert_partition(labels):
    """Labels are finite, within [0, 1] and sum to 1."""
    parts = stacked(labels)
    assert np.isfinite(parts).all()
    assert parts.min() >= 0
    np.testing.assert_allclose(parts.sum(axis=0), 1, atol=1e-5)


def parameters_of(graph, node):
    """The parameters of a graph's node, by their present names."""
    return next(step for step in graph.steps if step.name == node).parameters
