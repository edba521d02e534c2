"""The relief of the reference's skin in the photo's detail map."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphface.nodes.regions.nine import nine
from graphface.nodes.transfer.bands import bands
from graphface.nodes.types import DetailMap, Image
from graphface.testing import check_node

SIDE = 200
EVERYWHERE = np.ones((SIDE, SIDE), np.float32)
SKIN_COLOR = np.float32([0.8, 0.6, 0.5])


@pytest.fixture
def landmarks(make_face):
    return make_face(size=SIDE, scale=0.45)[1]


def wrinkled(depth=0.0, level=1.0, every=12):
    """Skin with dark lines, of a level of light."""
    x = np.arange(SIDE, dtype=np.float32)
    light = level * (1 - depth * np.exp(-np.square((x % every) - every / 2) / 2))
    return Image(np.ascontiguousarray(np.broadcast_to(light[None, :, None] * SKIN_COLOR, (SIDE, SIDE, 3)), np.float32))


def transferred(photo, reference, landmarks, mask=EVERYWHERE, reference_landmarks=None, regions=None, **settings):
    """The photo with the reference's relief."""
    blank = DetailMap(np.zeros_like(photo.pixels))
    other = reference_landmarks or landmarks
    made = bands(blank, photo, mask, EVERYWHERE, landmarks, reference, other, regions, **settings)
    return photo.pixels + made.offset


def depth_of(pixels):
    """Contrast of the middle's lines, darkest over brightest."""
    row = pixels[SIDE // 2, 60:140].mean(axis=1)
    return 1 - float(row.min() / row.max())


class TestBands:
    def test_itself(self, landmarks):
        """A photo that is its own reference stays as it is."""
        photo = wrinkled(0.2)
        assert np.abs(transferred(photo, photo, landmarks) - photo.pixels).max() < 2e-3

    def test_no_mask_no_change(self, landmarks):
        """Without a mask the very map comes back."""
        photo, own = wrinkled(), DetailMap(np.zeros((SIDE, SIDE, 3), np.float32))
        nothing = np.zeros_like(EVERYWHERE)
        assert bands(own, photo, nothing, EVERYWHERE, landmarks, wrinkled(0.3)) is own

    @pytest.mark.parametrize("level", [1.0, 0.4])
    def test_wrinkles_arrive(self, level, landmarks):
        """On dark skin as on pale skin, as deep as in the reference, and least in red, as relief is on skin."""
        got = transferred(wrinkled(level=level), wrinkled(0.2), landmarks)
        assert depth_of(got) == pytest.approx(0.2, abs=0.07)
        depths = 1 - (got[100, 60:140] / SKIN_COLOR).min(axis=0) / (got[100, 60:140] / SKIN_COLOR).max(axis=0)
        assert depths[0] < depths[1] < depths[2] < 1.7 * depths[0]

    def test_wrinkles_leave(self, landmarks):
        """A smooth reference smooths, without a change of the skin around."""
        got = transferred(wrinkled(0.2), wrinkled(), landmarks)
        assert depth_of(got) < 0.05
        assert got[60:140, 60:140].mean() == pytest.approx(wrinkled().pixels.mean(), rel=0.05)

    def test_no_reference(self, landmarks):
        """Is a reference of smooth skin."""
        photo = wrinkled(0.2)
        got, smooth = (transferred(photo, reference, landmarks) for reference in (None, wrinkled()))
        np.testing.assert_allclose(got, smooth, atol=5e-3)

    def test_another_tone_is_no_detail(self, landmarks):
        """A darker reference without relief changes nothing."""
        photo = wrinkled()
        assert np.abs(transferred(photo, wrinkled(level=0.3), landmarks) - photo.pixels).max() < 5e-3

    def test_strengths(self, landmarks):
        """A band of strength 0 stays; a region's factor is multiplied on top."""
        photo, reference = wrinkled(), wrinkled(0.2)
        nothing = transferred(photo, reference, landmarks, pores=0, lines=0, folds=0)
        np.testing.assert_array_equal(nothing, photo.pixels)
        regions = nine(photo, landmarks)
        off = {"nose": {"pores": 0.0, "lines": 0.0, "folds": 0.0}}
        got = transferred(photo, reference, landmarks, regions=regions, regional=off)
        change = np.abs(got - photo.pixels).max(axis=2)
        assert change[regions.nose > 0.999].max() < 1e-3
        assert change[regions.left_cheek > 0.999].max() > 0.05

    def test_a_harsh_reference(self, landmarks):
        """What few faces have is scaled down, unless it is asked for."""
        photo, reference = wrinkled(), wrinkled(0.7)
        as_it_is, usual = (depth_of(transferred(photo, reference, landmarks, harshest=h)) for h in (None, 1.0))
        assert usual < 0.6 * as_it_is

    def test_a_coarse_reference(self, landmarks, rng):
        """Pores that a small picture cannot show stay the photo's."""
        noise = rng.uniform(0.9, 1.1, (SIDE, SIDE, 1)).astype(np.float32)
        photo = replace(wrinkled(), pixels=wrinkled().pixels * noise)
        small = replace(landmarks, points=landmarks.points / 4)
        left = [
            transferred(photo, wrinkled(), landmarks, reference_landmarks=r)[80:120, 80:120] for r in (small, landmarks)
        ]
        assert left[0].std(axis=(0, 1)).mean() > 2 * left[1].std(axis=(0, 1)).mean()

    def test_black_and_white_are_finite(self, landmarks):
        """No picture gives values that are not finite."""
        black, white = (Image(np.full((SIDE, SIDE, 3), v, np.float32)) for v in (0, 1))
        assert np.isfinite(transferred(black, white, landmarks)).all()
        assert np.isfinite(transferred(white, black, landmarks)).all()

    def test_node(self, landmarks):
        """It keeps an operator's promises."""
        photo = wrinkled(0.1)
        check_node(bands, DetailMap(0 * photo.pixels), photo, EVERYWHERE, EVERYWHERE, landmarks, wrinkled(0.2))
