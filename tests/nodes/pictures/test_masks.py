"""Masks over the photo."""

from __future__ import annotations

import numpy as np

from graphface.nodes.pictures.masks import draw_head_masks, draw_mask, draw_regions, draw_segmentation
from graphface.nodes.types import REGIONS, HeadMasks, Image, Regions, Segmentation
from graphface.values.picture import View

PHOTO = Image(np.full((2, 3, 3), 0.5, np.float32))
OVER = View(above=lambda kind: PHOTO if kind is Image else None)


class TestMask:
    def test_with_and_without_photo(self):
        """Green over the photo; black to white without one."""
        mask = np.float32([[0, 0.5, 1], [0, 0, 0]])
        assert draw_mask(mask, View()).pixels[0, :, 0].tolist() == [0, 128, 255]
        pixels = draw_mask(mask, OVER).pixels.astype(int)
        assert np.ptp(pixels[0, 0]) == 0
        assert pixels[0, 2, 1] - pixels[0, 2, 0] > pixels[0, 1, 1] - pixels[0, 1, 0] > 0

    def test_note(self):
        """How much it covers, and what lies outside its range."""
        assert "covers 50.0%" in draw_mask(np.float32([[0, 1]]), View()).note
        assert "50.0% of the pixels lie outside 0 to 1" in draw_mask(np.float32([[0, 1.5]]), View()).note


def test_segmentation():
    """Hair is reddest, face greenest, the background as it is."""
    hair, face = np.float32([[1, 0, 0]]), np.float32([[0, 1, 0]])
    pixels = draw_segmentation(Segmentation(face, hair, 1 - hair - face), View()).pixels[0].astype(int)
    assert pixels[0, 0] == pixels[0].max()
    assert pixels[1, 1] == pixels[1].max()
    assert pixels[2].tolist() == [64, 64, 64]


def test_head_masks():
    """A narrower mask takes the place of the wider one, so each has one color."""
    ones, half = np.ones((1, 4), np.float32), np.float32([[0, 0, 1, 1]])
    pixels = draw_head_masks(HeadMasks(half * [[0, 0, 0, 1]], half, ones), View()).pixels[0]
    alone = draw_head_masks(HeadMasks(ones, ones, ones), View()).pixels[0]
    np.testing.assert_array_equal(pixels[3], alone[3])
    assert len(np.unique(pixels, axis=0)) == 3


def test_legend():
    """A picture for a file names the parts in it; one for a page has the names in its note only."""
    regions = Regions(**{name: np.zeros((400, 400), np.float32) for name in REGIONS})
    picture, paged = draw_regions(regions, View()), draw_regions(regions, View(400))
    assert len(np.unique(picture.pixels.reshape(-1, 3), axis=0)) > 9
    assert len(np.unique(paged.pixels.reshape(-1, 3), axis=0)) == 1
    assert all(name.replace("_", " ") in picture.note for name in REGIONS)
