"""What the small network is shown, and what it says of heads."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from portraits import landmarks_at, portrait

from graphface import GraphfaceWarning
from graphface.nodes.masks.cue import cue
from graphface.nodes.masks.label_weights import LabelWeights, read_weights, shipped_weights, write_weights
from graphface.nodes.masks.network_input import CHANNELS, SKIN, mirror_image, shown
from graphface.nodes.masks.upright import HEIGHT, WIDTH, upright_of
from graphface.nodes.types import Image


def cells_of(photo, landmarks):
    grid = upright_of(landmarks)
    return shown(grid.sampled(photo.pixels), grid.seen(photo.pixels.shape), grid.layout(landmarks))


def assert_partition(labels):
    stacked = np.stack([labels.face, labels.hair, labels.background])
    assert np.isfinite(stacked).all()
    assert stacked.min() >= 0
    np.testing.assert_allclose(stacked.sum(axis=0), 1, atol=1e-5)


class TestShown:
    def test_a_cell_for_four_pixels(self):
        """One vector for every two by two pixels of the grid, of ranges about 1."""
        cells = cells_of(*portrait()[:2])
        assert cells.shape == (HEIGHT // 2, WIDTH // 2, CHANNELS)
        assert np.abs(cells).max() < 5

    def test_colors_are_told_against_the_skin(self):
        """The sure skin of a drawn face is 0 in every color, whatever its color is."""
        photo, landmarks, _ = portrait(noise=0)
        for pixels in (photo.pixels, photo.pixels * 0.5):
            middle = cells_of(Image(pixels.astype(np.float32)), landmarks)[HEIGHT // 4 + 2, WIDTH // 4]
            np.testing.assert_allclose(middle[:12], 0, atol=1e-3)

    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_what_is_not_seen(self):
        """Beyond the photo's frame colors, roughness and the skin's color are 0."""
        photo, landmarks, _ = portrait()
        grid = upright_of(landmarks)
        cells = shown(grid.sampled(photo.pixels), np.zeros((HEIGHT, WIDTH), np.float32), grid.layout(landmarks))
        assert not cells[..., :16].any()
        assert not cells[..., SKIN:].any()

    def test_mirrored(self):
        """The cells of the mirrored picture are the mirrored cells: a symmetric face, another backdrop."""
        photo, landmarks, _ = portrait()
        grid = upright_of(landmarks)
        layout, pixels = grid.layout(landmarks), grid.sampled(photo.pixels)
        seen = grid.seen(photo.pixels.shape)
        there = shown(np.ascontiguousarray(pixels[:, ::-1]), np.ascontiguousarray(seen[:, ::-1]), layout)
        back = mirror_image(there)
        here = shown(pixels, seen, layout)
        inner = np.abs(here - back)[4:-4, 4:-4]
        assert np.median(inner) < 0.02
        np.testing.assert_allclose(back[..., :12], here[..., :12], atol=0.3)
        np.testing.assert_array_equal(mirror_image(mirror_image(here)), here)

    def test_no_skin_in_sight(self):
        """Where no sure skin lies in the frame that is said, and colors are compared with the usual one."""
        photo, _, _ = portrait()
        with pytest.warns(GraphfaceWarning, match="no skin"):
            cells = cells_of(photo, landmarks_at(1000, 1000, 30))
        assert np.isfinite(cells).all()


class TestCue:
    def test_a_drawn_head(self):
        """Of a drawn head most of the face, of the hair and of the background are found."""
        photo, landmarks, truth = portrait()
        labels = cue(photo, landmarks)
        found = np.stack([labels.face, labels.hair, labels.background]).argmax(axis=0)
        overlaps = [((found == k) & (truth == k)).sum() / ((found == k) | (truth == k)).sum() for k in range(3)]
        assert min(overlaps) > 0.6

    def test_rolled(self):
        """A photo that lies on its side is labelled like the upright one."""
        photo, landmarks, _ = portrait()
        side = photo.pixels.shape[0]
        points = landmarks.points.copy()
        points[:, 0], points[:, 1] = landmarks.points[:, 1], side - 1 - landmarks.points[:, 0]
        lying = cue(Image(np.ascontiguousarray(np.rot90(photo.pixels))), type(landmarks)(points, "facemesh468"))
        upright = cue(photo, landmarks)
        assert np.abs(np.rot90(upright.face) - lying.face).mean() < 0.01

    def test_size_of_the_photo_matters_little(self):
        """Twice the pixels, the same labels."""
        small, large = (cue(*portrait(side, noise=0)[:2]) for side in (200, 400))
        again = large.hair.reshape(200, 2, 200, 2).mean(axis=(1, 3))
        assert np.abs(again - small.hair).mean() < 0.01

    def test_far_away_is_background(self):
        """What lies beyond the grid is background."""
        photo = Image(np.full((400, 400, 3), 0.5, np.float32))
        labels = cue(photo, landmarks_at(60, 60, 10))
        assert labels.background[200:, 200:].min() == 1

    def test_noise_of_one_level(self):
        """Noise of one 8-bit level moves the labels by next to nothing."""
        photo, landmarks, _ = portrait()
        noise = np.random.default_rng(1).integers(-1, 2, photo.pixels.shape) / 255
        before, after = cue(photo, landmarks), cue(photo.with_pixels(photo.pixels + noise), landmarks)
        assert np.abs(before.hair - after.hair).max() < 0.1
        assert np.abs(before.hair - after.hair).mean() < 0.002

    @pytest.mark.parametrize("value", [0.0, 1.0, 0.4, np.nan, np.inf, -3.0, 1e30])
    def test_flat_pictures(self, value):
        """Black, white, grey and impossible pictures are partitioned."""
        assert_partition(cue(Image(np.full((90, 70, 3), value, np.float32)), landmarks_at(35, 45, 20)))

    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    @settings(deadline=None, max_examples=25)
    @given(
        st.integers(1, 60),
        st.integers(1, 60),
        st.floats(-300, 300),
        st.floats(-300, 300),
        st.floats(0.01, 500),
        st.floats(-3.1, 3.1),
    )
    def test_any_place(self, height, width, x, y, interocular, roll):
        """A photo of a pixel, a face cut by the frame, outside of it, a speck or huge: a partition."""
        photo = Image(np.random.default_rng(0).uniform(0, 1, (height, width, 3)).astype(np.float32))
        assert_partition(cue(photo, landmarks_at(x, y, interocular, roll)))

    @pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")
    def test_landmarks_that_are_no_numbers(self):
        """Landmarks of NaN give labels still."""
        landmarks = landmarks_at(30, 30, 10)
        landmarks.points[:] = np.nan
        assert_partition(cue(Image(np.full((60, 60, 3), 0.5, np.float32)), landmarks))


class TestWeights:
    def test_of_the_users_own(self):
        """A network that has learned nothing takes everything on the grid for anything."""
        photo, landmarks, _ = portrait()
        nothing = LabelWeights({name: np.zeros_like(values) for name, values in shipped_weights().items()})
        found = cue(photo, landmarks, nothing)
        assert_partition(found)
        np.testing.assert_allclose(found.face[90:110, 90:110], 1 / 3, atol=1e-5)

    def test_from_a_file(self, tmp_path):
        """A file as `graphface models labels` writes it does as well as the shipped one, being the same."""
        photo, landmarks, _ = portrait()
        write_weights(shipped_weights(), {}, tmp_path / "mine.safetensors")
        found = cue(photo, landmarks, LabelWeights(read_weights(tmp_path / "mine.safetensors")))
        np.testing.assert_array_equal(found.face, cue(photo, landmarks).face)
