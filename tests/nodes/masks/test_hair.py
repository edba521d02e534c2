"""The hair detector on a head whose labels are known."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import BACKDROP, HAIR, SKIN, portrait
from stages import detected, overlap, parameters_of

from graphface import GraphfaceWarning, load
from graphface.nodes.masks.hair import hair
from graphface.testing import check_node


class TestHair:
    @pytest.mark.parametrize("color", [HAIR, (0.85, 0.75, 0.45), (0.9, 0.9, 0.92), (0.5, 0.2, 0.1)])
    def test_found_by_color(self, color):
        """Dark, fair, white and red hair on top of the head is found."""
        photo, landmarks, labels = portrait(hair=color)
        found = detected(photo, landmarks)[2]
        assert overlap(found.mask > 0.5, (labels == 1)) > 0.8

    def test_response_reaches_beyond_the_mask(self):
        """The mask is the response within the normal mask."""
        photo, landmarks, _ = portrait()
        _, masks, found = detected(photo, landmarks)
        np.testing.assert_array_equal(found.mask, found.response * masks.normal)

    @pytest.mark.parametrize("color", [SKIN, tuple(min(1.0, c + 0.12) for c in SKIN)])
    def test_bald(self, color):
        """A scalp of the face's color, or lighter by a highlight, is no hair."""
        photo, landmarks, _ = portrait(hair=color)
        assert (detected(photo, landmarks)[2].mask > 0.5).mean() < 0.002

    def test_backdrop_around_a_small_skull(self):
        """Backdrop within the solids of the head is no hair."""
        import cv2

        photo, landmarks, labels = portrait(hair=SKIN)
        pixels = photo.pixels.copy()
        shrunk = cv2.erode(np.uint8(labels == 1) | np.uint8(labels == 0), np.ones((3, 3), np.uint8), iterations=5)
        pixels[(labels == 1) & (shrunk == 0)] = BACKDROP
        assert (detected(photo.with_pixels(pixels), landmarks)[2].mask > 0.5).mean() < 0.002

    def test_the_same_color_everywhere(self):
        """Where the top looks just like the sides, hair is never certain."""
        photo, landmarks, _ = portrait(hair=BACKDROP)
        assert detected(photo, landmarks)[2].response.max() < 0.8

    def test_former_names(self):
        """Parameters keep their former names in graphs, with a warning."""
        with pytest.warns(GraphfaceWarning, match="min_share"):
            graph = load("segment", variants=["detector"], set={"detected.least": 0.2})
        assert parameters_of(graph, "detected")["min_share"] == 0.2

    def test_node(self):
        """It keeps an operator's promises."""
        photo, landmarks, _ = portrait(120)
        features, masks, _ = detected(photo, landmarks)
        check_node(hair, features, masks, landmarks)
