"""Labels by MediaPipe's selfie segmentation: our part with a stand-in for the network, the rest with the network."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from portraits import portrait
from stages import masks_of, parameters_of, stacked

from graphface import GraphfaceWarning, load
from graphface.assets.asset import AssetUnavailable
from graphface.nodes.geometry.facemesh import facemesh as mesh_of
from graphface.nodes.landmarks.facemesh import facemesh
from graphface.nodes.masks import selfie_network
from graphface.nodes.masks.geometric import geometric
from graphface.nodes.masks.network import network
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Image, Landmarks
from graphface.nodes.types.image import image_from_array
from graphface.testing import check_node


def by_color(pixels):
    """A network that takes red for hair, green for face skin and anything else for background."""
    logits = np.full((256, 256, 6), -9.0, np.float32)
    top = pixels.argmax(axis=2)
    for color, kind in ((0, 1), (1, 3), (2, 0)):
        logits[..., kind][top == color] = 9
    return logits


def painted(labels) -> Image:
    """A picture whose colors say what everything is."""
    colors = np.array([[0.1, 0.9, 0.1], [0.9, 0.1, 0.1], [0.1, 0.1, 0.9]], np.float32)
    return Image(colors[labels])


@pytest.fixture
def replace_network(monkeypatch):
    """Replaces the network by a stand-in."""
    return lambda stand_in: monkeypatch.setattr(selfie_network, "_logits", stand_in)


class TestWithAStandIn:
    def test_labels_land_where_they_were_seen(self, replace_network):
        """What the network sees in the window is where it is in the photo."""
        replace_network(by_color)
        photo, landmarks, truth = portrait()
        found = network(painted(truth), landmarks, masks_of(photo, landmarks))
        assert (stacked(found).argmax(axis=0) == truth).mean() > 0.97

    @pytest.mark.parametrize("turns", [1, 2, 3])
    def test_lying_faces_are_rotated_upright(self, replace_network, turns):
        """A photo turned by quarters gives the turned labels, and the network sees the head's top above."""
        hair_rows = []

        def stand_in(pixels):
            hair_rows.append(pixels.argmax(axis=2) == 0)
            return by_color(pixels)

        replace_network(stand_in)
        photo, landmarks, truth = portrait()
        size = photo.pixels.shape[0]
        assert photo.pixels.shape[0] == photo.pixels.shape[1]
        x, y, z = landmarks.points.T
        for _ in range(turns):  # counter-clockwise, as np.rot90
            x, y = y, size - 1 - x
        lying = Landmarks(np.stack([x, y, z], axis=1).astype(np.float32), landmarks.scheme)
        picture = painted(np.rot90(truth, turns))
        found = network(picture, lying, masks_of(picture, lying), mirrored=False)
        assert (stacked(found).argmax(axis=0) == np.rot90(truth, turns)).mean() > 0.97
        assert hair_rows[0][:86].sum() > 3 * hair_rows[0][-86:].sum()

    def test_paint_on_the_face_stays_face(self, replace_network):
        """What the network takes for an accessory is face within the conservative mask."""
        replace_network(lambda pixels: by_color(np.broadcast_to(np.float32([0, 0, 1]), pixels.shape)))
        photo, landmarks, _ = portrait()
        masks = masks_of(photo, landmarks)
        found = network(photo, landmarks, masks)
        deep = cv2.erode(masks.conservative, np.ones((9, 9), np.uint8)) > 0.99
        assert found.face[deep].min() > 0.95
        assert found.face[masks.aggressive < 0.01].max() < 0.05

    def test_given_seeds_are_hair(self, replace_network):
        """What the user says is hair is hair, whatever the network sees there."""
        replace_network(by_color)
        photo, landmarks, truth = portrait()
        seeds = np.zeros(truth.shape, np.float32)
        seeds[90:110, 90:110] = 1
        found = network(painted(truth), landmarks, masks_of(photo, landmarks), seeds)
        assert found.hair[94:106, 94:106].min() > 0.95
        assert found.face[94:106, 94:106].max() < 0.05

    def test_somebody_beside_is_background(self, replace_network):
        """A second head that touches nothing of this one is not labelled."""
        replace_network(by_color)
        photo, landmarks, truth = portrait()
        crowd = truth.copy()
        crowd[:, -20:] = 1
        between = crowd[:, -30:-20]
        between[:] = 2
        found = network(painted(crowd), landmarks, masks_of(photo, landmarks))
        assert found.hair[:, -12:].max() < 0.1

    def test_former_names(self):
        """Parameters keep their former names in graphs, with a warning."""
        with pytest.warns(GraphfaceWarning, match="inverse_temperature"):
            graph = load("segment", variants=["network"], set={"classes.certainty": 3.0})
        assert parameters_of(graph, "classes")["inverse_temperature"] == 3.0

    @pytest.mark.parametrize("value", [0.0, 1.0, np.nan, np.inf])
    @pytest.mark.parametrize("shape", [(1, 1), (3, 200), (200, 3), (64, 64)])
    def test_always_a_partition(self, replace_network, value, shape):
        """Black, white, broken, thin and tiny pictures: labels are finite, in range and sum to one."""
        replace_network(by_color)
        photo = Image(np.full((*shape, 3), value, np.float32))
        landmarks = portrait()[1]
        found = stacked(network(photo, landmarks, masks_of(photo, landmarks)))
        assert np.isfinite(found).all()
        assert found.min() >= 0
        np.testing.assert_allclose(found.sum(axis=0), 1, atol=1e-5)


@pytest.fixture(scope="module")
def astronaut():
    """A photograph, its landmarks and masks; skips where the network or the landmarks' weights cannot be had."""
    pytest.importorskip("ai_edge_litert.interpreter", reason="needs pip install 'graphface[network]'")
    photo = image_from_array(np.asarray(pytest.importorskip("skimage.data").astronaut()))
    try:
        landmarks = facemesh(photo)
        selfie_network._interpreter()
    except AssetUnavailable as error:
        pytest.skip(str(error))
    return photo, landmarks, geometric(photo, landmarks, rasterize(mesh_of(landmarks), photo))


class TestNetwork:
    def test_knows_a_portrait(self, astronaut):
        """Face, hair on both sides, suit and flag of a well-known photograph."""
        found = stacked(network(*astronaut))
        for (y, x), label in (
            ((110, 225), 0),
            ((150, 215), 0),
            ((60, 225), 1),
            ((110, 165), 1),
            ((110, 275), 1),
            ((300, 200), 2),
            ((150, 60), 2),
            ((400, 420), 2),
        ):
            assert found[:, y, x].argmax() == label, (y, x)

    def test_does_not_jump_with_noise(self, astronaut):
        """Noise of one 8-bit level moves no label by more than 2 %."""
        photo, landmarks, masks = astronaut
        noise = np.random.default_rng(0).integers(-1, 2, photo.pixels.shape) / np.float32(255)
        before = stacked(network(photo, landmarks, masks)).argmax(axis=0)
        shaken = photo.with_pixels(np.clip(photo.pixels + noise, 0, 1))
        after = stacked(network(shaken, landmarks, masks)).argmax(axis=0)
        for k in range(3):
            assert ((before == k) & (after == k)).sum() >= 0.98 * ((before == k) | (after == k)).sum()

    def test_keeps_the_contract(self, astronaut):
        """Pure, deterministic, and what its ports say."""
        check_node(network, *astronaut)
