"""The input of the label network."""

from __future__ import annotations

import numpy as np
import pytest
from portraits import landmarks_at, portrait

from graphface import GraphfaceWarning
from graphface.nodes.masks.network_input import CHANNELS, SKIN, mirrored_input, network_input
from graphface.nodes.masks.upright_grid import HEIGHT, WIDTH, upright_grid
from graphface.nodes.types import Image


def input_of(photo, landmarks):
    grid = upright_grid(landmarks)
    return network_input(grid.sampled(photo.pixels), grid.inside(photo.pixels.shape), grid.layout(landmarks))


class TestNetworkInput:
    def test_a_cell_for_four_pixels(self):
        """One vector for every 2 x 2 pixels of the grid, of ranges about 1."""
        cells = input_of(*portrait()[:2])
        assert cells.shape == (HEIGHT // 2, WIDTH // 2, CHANNELS)
        assert np.abs(cells).max() < 5

    def test_colors_are_relative_to_the_skin(self):
        """The surely visible skin of a drawn face is 0 in every color, whatever its color is."""
        photo, landmarks, _ = portrait(noise=0)
        for pixels in (photo.pixels, photo.pixels * 0.5):
            middle = input_of(Image(pixels.astype(np.float32)), landmarks)[HEIGHT // 4 + 2, WIDTH // 4]
            np.testing.assert_allclose(middle[:12], 0, atol=1e-3)

    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_beyond_the_frame(self):
        """Outside the photo colors, roughness and the skin's color are 0."""
        photo, landmarks, _ = portrait()
        grid = upright_grid(landmarks)
        outside = np.zeros((HEIGHT, WIDTH), np.float32)
        cells = network_input(grid.sampled(photo.pixels), outside, grid.layout(landmarks))
        assert not cells[..., :16].any()
        assert not cells[..., SKIN:].any()

    def test_no_visible_skin(self):
        """Where no skin lies in the frame there is a warning, and colors are compared with average skin."""
        photo, _, _ = portrait()
        with pytest.warns(GraphfaceWarning, match="no skin"):
            cells = input_of(photo, landmarks_at(1000, 1000, 30))
        assert np.isfinite(cells).all()


class TestMirroredInput:
    def test_is_the_input_of_the_mirrored_picture(self):
        """For a symmetric face before another backdrop."""
        photo, landmarks, _ = portrait()
        grid = upright_grid(landmarks)
        layout, pixels = grid.layout(landmarks), grid.sampled(photo.pixels)
        inside = grid.inside(photo.pixels.shape)
        of_mirrored = network_input(
            np.ascontiguousarray(pixels[:, ::-1]), np.ascontiguousarray(inside[:, ::-1]), layout
        )
        back = mirrored_input(of_mirrored)
        here = network_input(pixels, inside, layout)
        inner = np.abs(here - back)[4:-4, 4:-4]
        assert np.median(inner) < 0.02
        np.testing.assert_allclose(back[..., :12], here[..., :12], atol=0.3)
        np.testing.assert_array_equal(mirrored_input(mirrored_input(here)), here)
