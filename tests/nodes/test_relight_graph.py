"""The shipped graphs, run by the engine on a real photograph."""

from __future__ import annotations

import numpy as np
import pytest

import graphface
from graphface.assets import AssetUnavailable
from graphface.nodes.image import image_from_array


@pytest.fixture(scope="module")
def astronaut():
    return image_from_array(pytest.importorskip("skimage.data").astronaut())


def relit(photo, scene, **choices):
    try:
        return graphface.load("relight", **choices).run(photo=photo, scene=scene)["image"]
    except graphface.RunError as error:
        if isinstance(error.__cause__, AssetUnavailable) or isinstance(error, AssetUnavailable):
            pytest.skip(str(error))
        raise


class TestRelight:
    @pytest.mark.parametrize("encoding", ["srgb", "linear"])
    @pytest.mark.parametrize("detail", ["detail.additive", "detail.multiplicative"])
    def test_the_estimated_light_returns_the_photo(self, astronaut, encoding, detail):
        """Adding no light changes no value by 1/255, before quantization, whatever the encoding and the detail map."""
        image = relit(
            astronaut,
            {"mode": "add"},
            replace={"face/detail": detail},
            set={"face/working.encoding": encoding},
        )
        assert np.abs(image.pixels - astronaut.pixels).max() <= 1 / 255

    def test_light_from_the_left_brightens_the_left(self, astronaut):
        """The left half of the face gains on the right half."""
        light = {"type": "directional", "azimuth": -60}
        image = relit(astronaut, {"ambient": 0.2, "lights": [light]})
        change = (image.pixels - astronaut.pixels).mean(axis=2)[70:170, 170:280]
        assert change[:, :55].mean() > change[:, 55:].mean() + 0.05

    def test_a_small_change_of_light_is_a_small_change(self, astronaut):
        """Turning the light by a degree moves no pixel far."""
        one, two = (
            relit(astronaut, {"ambient": 0.2, "lights": [{"type": "directional", "azimuth": a}]}).pixels
            for a in (40, 41)
        )
        assert 0 < np.abs(one - two).max() < 0.05
