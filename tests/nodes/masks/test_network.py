"""Labels by MediaPipe's selfie segmentation: ours with a stand-in for the network, the rest with the network."""

from __future__ import annotations

import sys
import threading

import cv2
import numpy as np
import pytest
from portraits import portrait, surface_of

from graphface import UsageError
from graphface.assets.asset import AssetUnavailable
from graphface.nodes.geometry.facemesh import facemesh as mesh_of
from graphface.nodes.landmarks.facemesh import facemesh
from graphface.nodes.masks import network as module
from graphface.nodes.masks.geometric import geometric
from graphface.nodes.masks.network import network
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Image, Landmarks
from graphface.nodes.types.image import image_from_array
from graphface.testing import check_node


def masks_of(photo, landmarks):
    return geometric(photo, landmarks, surface_of(landmarks, photo.pixels.shape[:2]))


def parts(labels):
    return np.stack([labels.face, labels.hair, labels.background])


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
def seeing(monkeypatch):
    """Puts a stand-in in the network's place."""
    return lambda stand_in: monkeypatch.setattr(module, "_logits", stand_in)


class TestOurPart:
    def test_labels_land_where_they_were_seen(self, seeing):
        """What the network sees in the window is where it is in the photo."""
        seeing(by_color)
        photo, landmarks, truth = portrait()
        found = network(painted(truth), landmarks, masks_of(photo, landmarks))
        assert (parts(found).argmax(axis=0) == truth).mean() > 0.97

    @pytest.mark.parametrize("turns", [1, 2, 3])
    def test_lying_faces_are_shown_upright(self, seeing, turns):
        """A photo turned by quarters gives the turned labels, and the network sees the head's top above."""
        shown = []

        def stand_in(pixels):
            shown.append(pixels.argmax(axis=2) == 0)
            return by_color(pixels)

        seeing(stand_in)
        photo, landmarks, truth = portrait()
        size = photo.pixels.shape[0]
        assert photo.pixels.shape[0] == photo.pixels.shape[1]
        x, y, z = landmarks.points.T
        for _ in range(turns):  # counter-clockwise, as np.rot90
            x, y = y, size - 1 - x
        lying = Landmarks(np.stack([x, y, z], axis=1).astype(np.float32), landmarks.scheme)
        picture = painted(np.rot90(truth, turns))
        found = network(picture, lying, masks_of(picture, lying), mirrored=False)
        assert (parts(found).argmax(axis=0) == np.rot90(truth, turns)).mean() > 0.97
        assert shown[0][:86].sum() > 3 * shown[0][-86:].sum()

    def test_paint_on_the_face_stays_face(self, seeing):
        """What the network takes for an accessory is face within the conservative mask."""
        seeing(lambda pixels: by_color(np.broadcast_to(np.float32([0, 0, 1]), pixels.shape)))
        photo, landmarks, _ = portrait()
        masks = masks_of(photo, landmarks)
        found = network(photo, landmarks, masks)
        deep = cv2.erode(masks.conservative, np.ones((9, 9), np.uint8)) > 0.99
        assert found.face[deep].min() > 0.95
        assert found.face[masks.aggressive < 0.01].max() < 0.05

    def test_given_seeds_are_hair(self, seeing):
        """What the user says is hair is hair, whatever the network sees there."""
        seeing(by_color)
        photo, landmarks, truth = portrait()
        seeds = np.zeros(truth.shape, np.float32)
        seeds[90:110, 90:110] = 1
        found = network(painted(truth), landmarks, masks_of(photo, landmarks), seeds)
        assert found.hair[94:106, 94:106].min() > 0.95
        assert found.face[94:106, 94:106].max() < 0.05

    def test_somebody_beside_is_background(self, seeing):
        """A second head that touches nothing of this one is not labelled."""
        seeing(by_color)
        photo, landmarks, truth = portrait()
        crowd = truth.copy()
        crowd[:, -20:] = 1
        between = crowd[:, -30:-20]
        between[:] = 2
        found = network(painted(crowd), landmarks, masks_of(photo, landmarks))
        assert found.hair[:, -12:].max() < 0.1

    def test_mirrored_labels_are_averaged(self, seeing):
        """A network that prefers one side does so no more."""
        ramp = np.linspace(-4, 4, 256, dtype=np.float32)

        def stand_in(pixels):
            logits = np.zeros((256, 256, 6), np.float32)
            logits[..., 1] = ramp
            return logits

        seeing(stand_in)
        chances = module.class_chances(portrait()[0].pixels, mirrored=True)
        np.testing.assert_allclose(chances, chances[:, ::-1], atol=1e-6)

    @pytest.mark.parametrize("value", [0.0, 1.0, np.nan, np.inf])
    @pytest.mark.parametrize("shape", [(1, 1), (3, 200), (200, 3), (64, 64)])
    def test_always_a_partition(self, seeing, value, shape):
        """Black, white, broken, thin and tiny pictures: labels are finite, in range and sum to one."""
        seeing(by_color)
        photo = Image(np.full((*shape, 3), value, np.float32))
        landmarks = portrait()[1]
        found = parts(network(photo, landmarks, masks_of(photo, landmarks)))
        assert np.isfinite(found).all()
        assert found.min() >= 0
        np.testing.assert_allclose(found.sum(axis=0), 1, atol=1e-5)

    def test_without_litert(self, monkeypatch):
        """A machine without the extra is told what to install."""
        monkeypatch.setattr(module, "_threads", threading.local())
        monkeypatch.setitem(sys.modules, "ai_edge_litert.interpreter", None)
        photo, landmarks, _ = portrait()
        with pytest.raises(UsageError, match=r"pip install 'graphface\[network\]'"):
            network(photo, landmarks, masks_of(photo, landmarks))


@pytest.fixture(scope="module")
def astronaut():
    """A photograph, its landmarks and masks; skips where the network or the landmarks' weights cannot be had."""
    pytest.importorskip("ai_edge_litert.interpreter", reason="needs pip install 'graphface[network]'")
    photo = image_from_array(np.asarray(pytest.importorskip("skimage.data").astronaut()))
    try:
        landmarks = facemesh(photo)
        module._interpreter()
    except AssetUnavailable as error:
        pytest.skip(str(error))
    return photo, landmarks, geometric(photo, landmarks, rasterize(mesh_of(landmarks), photo))


class TestNetwork:
    def test_knows_a_portrait(self, astronaut):
        """Face, hair on both sides, suit and flag of a well-known photograph."""
        found = parts(network(*astronaut))
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
        before = parts(network(photo, landmarks, masks)).argmax(axis=0)
        shaken = photo.with_pixels(np.clip(photo.pixels + noise, 0, 1))
        after = parts(network(shaken, landmarks, masks)).argmax(axis=0)
        for k in range(3):
            assert ((before == k) & (after == k)).sum() >= 0.98 * ((before == k) | (after == k)).sum()

    def test_keeps_the_contract(self, astronaut):
        """Pure, deterministic, and what its ports say."""
        check_node(network, *astronaut)

    def test_says_nothing(self, astronaut, capfd, monkeypatch):
        """LiteRT's chatter does not reach the terminal."""
        monkeypatch.setattr(module, "_threads", threading.local())
        network(*astronaut)
        assert capfd.readouterr() == ("", "")
