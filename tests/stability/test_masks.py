"""Hard photos through the whole segmentation: a partition always, and no jumps."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from portraits import HAIR, SKIN, landmarks_at, portrait, surface_of

from graphface.nodes.masks.classify import classify
from graphface.nodes.masks.cue import cue
from graphface.nodes.masks.cued_hair import cued_hair
from graphface.nodes.masks.features import pixel_features
from graphface.nodes.masks.geometric import geometric
from graphface.nodes.masks.hair import hair
from graphface.nodes.matting.closed_form import closed_form
from graphface.nodes.matting.guided import guided
from graphface.nodes.matting.knn import knn
from graphface.nodes.types import Image

pytestmark = pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")


def segmented(photo, landmarks, matting=guided):
    masks = geometric(photo, landmarks, surface_of(landmarks, photo.pixels.shape[:2]))
    seen = pixel_features(photo, landmarks)
    labels = classify(seen, masks, hair(seen, masks, landmarks), landmarks, photo)
    return matting(photo, labels, landmarks)


def segmented_from_a_cue(photo, landmarks):
    masks = geometric(photo, landmarks, surface_of(landmarks, photo.pixels.shape[:2]))
    known = cue(photo, landmarks)
    labels = classify(pixel_features(photo, landmarks), masks, cued_hair(known, masks), landmarks, photo, known)
    return guided(photo, labels, landmarks)


def assert_partition(labels):
    stacked = np.stack([labels.face, labels.hair, labels.background])
    assert np.isfinite(stacked).all()
    assert stacked.min() >= 0
    assert stacked.max() <= 1 + 1e-6
    np.testing.assert_allclose(stacked.sum(axis=0), 1, atol=1e-5)


def picture(kind, side=120):
    rng = np.random.default_rng(3)
    pixels = {
        "black": np.zeros((side, side, 3)),
        "saturated": np.ones((side, side, 3)),
        "flat": np.full((side, side, 3), 0.4),
        "two colors": np.where(np.arange(side)[:, None, None] < side // 2, (0.2, 0.1, 0.1), (0.8, 0.6, 0.5))
        * np.ones((side, side, 3)),
        "salt and pepper": rng.integers(0, 2, (side, side, 1)) * np.ones(3),
        "noise": rng.uniform(0, 1, (side, side, 3)),
        "holes": np.where(rng.uniform(size=(side, side, 1)) < 0.1, np.nan, 0.5) * np.ones(3),
    }[kind]
    return Image(pixels.astype(np.float32))


@pytest.mark.parametrize("kind", ["black", "saturated", "flat", "two colors", "salt and pepper", "noise", "holes"])
@pytest.mark.parametrize("matting", [guided, closed_form, knn])
def test_hard_pictures(kind, matting):
    """Pictures that say nothing, or too much, are partitioned."""
    assert_partition(segmented(picture(kind), landmarks_at(60, 60, 26), matting))


@pytest.mark.parametrize("kind", ["black", "saturated", "flat", "two colors", "salt and pepper", "noise", "holes"])
def test_hard_pictures_from_a_cue(kind):
    """So are they where the classifiers start from the small network."""
    assert_partition(segmented_from_a_cue(picture(kind), landmarks_at(60, 60, 26)))


@pytest.mark.parametrize(
    ("x", "y", "interocular"),
    [
        (60, 60, 200.0),
        (60, 60, 13.0),
        (0, 60, 40.0),
        (120, 120, 40.0),
        (60, -10, 40.0),
        (60, 60, 0.5),
        (500, 500, 20.0),
    ],
    ids=["fills the frame", "40 pixels", "cut left", "corner", "cut above", "a pixel", "outside"],
)
def test_hard_places(x, y, interocular):
    """A face that fills the frame, is tiny, cut by the frame or outside of it."""
    photo = portrait(120)[0]
    assert_partition(segmented(photo, landmarks_at(x, y, interocular)))
    assert_partition(segmented_from_a_cue(photo, landmarks_at(x, y, interocular)))


def test_single_hair_pixel():
    """One dark pixel on a bald head makes no head of hair."""
    photo, landmarks, _ = portrait(hair=SKIN)
    pixels = photo.pixels.copy()
    pixels[45, 100] = HAIR
    labels = segmented(photo.with_pixels(pixels), landmarks)
    assert_partition(labels)
    assert labels.hair.mean() < 0.01


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.floats(-50, 150), st.floats(-50, 150), st.floats(0.01, 400), st.floats(-3.2, 3.2), st.integers(0, 99))
def test_any_face_in_any_picture(x, y, interocular, roll, seed):
    """Wherever the points lie, and whatever the colors are."""
    rng = np.random.default_rng(seed)
    pixels = np.repeat(np.repeat(rng.uniform(0, 1, (8, 6, 3)), 10, axis=0), 10, axis=1)
    assert_partition(segmented(Image(pixels.astype(np.float32)), landmarks_at(x, y, interocular, roll)))


@pytest.mark.parametrize("seed", range(4))
def test_noise_of_one_level(seed):
    """Noise of one 8-bit level changes no label's overlap with itself below 0.98."""
    photo, landmarks, _ = portrait(300)
    shaken = photo.pixels + np.random.default_rng(seed).integers(-1, 2, photo.pixels.shape) / 255
    before, after = segmented(photo, landmarks), segmented(photo.with_pixels(np.clip(shaken, 0, 1)), landmarks)
    for name in ("face", "hair", "background"):
        a, b = getattr(before, name) > 0.5, getattr(after, name) > 0.5
        assert (a & b).sum() / (a | b).sum() > 0.98
