"""The shipped graphs, run by the engine on a real photograph."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest

import graphface
from graphface.assets.asset import AssetUnavailable
from graphface.nodes.types.image import image_from_array


@pytest.fixture(scope="module")
def astronaut():
    return image_from_array(pytest.importorskip("skimage.data").astronaut())


def relit(photo, scene, **choices):
    return run(graphface.load("relight", **choices), photo=photo, scene=scene)["image"]


def run(graph, **inputs):
    """Everything the graph declares, with nothing memoized before."""
    try:
        return graph.run(evaluator=graphface.Evaluator(), **inputs)
    except graphface.RunError as error:
        if isinstance(error.__cause__, AssetUnavailable) or isinstance(error, AssetUnavailable):
            pytest.skip(str(error))
        raise


class TestRelight:
    @pytest.mark.parametrize("encoding", ["srgb", "linear"])
    @pytest.mark.parametrize("detail", ["detail.additive", "detail.multiplicative", "detail.split"])
    def test_the_estimated_light_returns_the_photo(self, astronaut, encoding, detail):
        """Adding next to no light changes no value by 1/255, before quantization, whatever encoding and detail map.

        Adding none at all would return the photo without any of the stages that have to cancel out here.
        """
        hardly = {"mode": "add", "lights": [{"type": "directional", "azimuth": -60, "intensity": 1e-7}]}
        graph = graphface.load("relight", replace={"face/detail": detail}, set={"face/working.encoding": encoding})
        result = run(graph, photo=astronaut, scene=hardly)
        assert {"shade", "composite", "relit", "face/detail"} <= {r.name for r in result.records if r.state == "ran"}
        assert np.abs(result["image"].pixels - astronaut.pixels).max() <= 1 / 255

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


@pytest.fixture(scope="module")
def large(astronaut):
    """The photograph enlarged threefold, so that its eyes are farther apart than the working size asks for."""
    import cv2

    return image_from_array(np.clip(cv2.resize(astronaut.pixels[:340, 50:390], None, fx=3, fy=3), 0, 1))


class TestWorkingSize:
    LIGHT: ClassVar = {"ambient": 0.2, "background": 0.5, "lights": [{"type": "directional", "azimuth": -60}]}

    def test_a_photo_of_that_size_is_relit_as_it_is(self, astronaut):
        """Every byte is that of a graph without a working size."""
        one, other = (
            relit(astronaut, self.LIGHT, set={"face/working_size.resolution": pixels}).pixels for pixels in (160, None)
        )
        np.testing.assert_array_equal(one, other)

    @pytest.mark.parametrize("lamp", [{}, {"type": "point", "position": [-1, -1, 2.5], "kelvin": 2500}])
    def test_a_large_photo_is_relit_as_if_at_its_own_size(self, large, lamp):
        """Nothing that an eye would see is lost, and the picture has the photo's size."""
        light = {**self.LIGHT, "lights": [lamp]} if lamp else self.LIGHT
        one, other = (relit(large, light, set={"face/working_size.resolution": pixels}).pixels for pixels in (80, None))
        assert one.shape == other.shape
        assert not np.array_equal(one, other)
        assert np.square(one - other).mean() < 1e-4

    def test_another_method_changes_a_large_photo(self, large):
        """What the formulas of the shipped graph do not say of the result is added."""
        choices = {"replace": {"face/detail": "detail.none"}}
        one, other = (
            relit(large, self.LIGHT, set={"face/working_size.resolution": pixels}, **choices).pixels
            for pixels in (80, None)
        )
        shipped = relit(large, self.LIGHT, set={"face/working_size.resolution": 80}).pixels
        assert np.square(one - other).mean() < np.square(shipped - other).mean() / 2

    def test_hardly_any_light_returns_a_large_photo(self, large):
        """By 1/255, as at its own size."""
        hardly = {"mode": "add", "lights": [{"type": "directional", "azimuth": -60, "intensity": 1e-7}]}
        pixels = relit(large, hardly, set={"face/working_size.resolution": 80}).pixels
        assert np.abs(pixels - large.pixels).max() <= 1 / 255


def planned(scene, outputs=("image",)):
    """Fate and reason of every node for a scene, before anything runs."""
    from graphface import Evaluator
    from graphface.evaluate.plan import plan

    graph = graphface.load("relight")
    inputs = {"photo": image_from_array(np.zeros((8, 8, 3), np.uint8)), "scene": scene}
    return {p.name: p for p in plan(graph.request(inputs, outputs), Evaluator())}


SUN = {"type": "directional", "azimuth": 30}


class TestOnlyWhatTheSceneCallsFor:
    def test_no_geometry_for_the_photos_own_light(self):
        """The scene that changes nothing runs no face operator at all."""
        nodes = planned({"mode": "add"})
        ran = {name for name, node in nodes.items() if node.fate == "run"}
        assert ran == {"full_size", "image"}
        assert "photo's own light" in str(nodes["face/mesh"].reason)

    @pytest.mark.parametrize(
        ("scene", "node", "words"),
        [
            ({"lights": [{"type": "sh", "preset": "left"}]}, "shadows", "casts a shadow"),
            ({"lights": [{**SUN, "shadow": "none"}]}, "shadows", "casts a shadow"),
            ({"lights": [{**SUN, "azimuth": 180}]}, "shadows", "casts a shadow"),
            ({"lights": [SUN]}, "scatter", "scatter: 0"),
            ({"lights": [SUN], "specular": 0}, "highlights", "specular: 0"),
            ({"lights": [{"type": "sh", "preset": "left"}]}, "highlights", "no light that makes highlights"),
            ({"lights": [SUN]}, "panorama", "no environment light"),
            ({"lights": [SUN], "background": 0}, "lamps", "background: 0"),
            ({"lights": [SUN], "hair": 0, "background": 1}, "shine", "hair: 0"),
        ],
    )
    def test_a_stage_is_skipped_with_the_reason(self, scene, node, words):
        """Exactly, before the run, and in words."""
        found = planned(scene)[node]
        assert found.fate == "skipped"
        assert words in str(found.reason)

    @pytest.mark.parametrize(
        ("scene", "node"),
        [
            ({"lights": [SUN]}, "shadows"),
            ({"lights": [SUN], "scatter": 0.03}, "scatter"),
            ({"lights": [SUN], "specular": 1}, "highlights"),
            ({"lights": [SUN], "hair": 0.5, "background": 1}, "shine"),
            ({"lights": [SUN], "hair": 0, "background": 0.5}, "face/segment/classes"),
        ],
    )
    def test_a_stage_that_is_asked_for_runs(self, scene, node):
        """The other side of the same rules."""
        assert planned(scene)[node].fate == "run"


class TestScenes:
    @pytest.mark.parametrize("name", ["window-left", "candle", "red-blue", "stage"])
    def test_a_shipped_scene_makes_a_picture(self, astronaut, name):
        """Finite, in range, and another picture than before."""
        pixels = relit(astronaut, f"scenes/{name}.yaml", profiles=["draft"]).pixels
        assert np.isfinite(pixels).all()
        assert pixels.min() >= 0
        assert pixels.max() <= 1
        assert np.abs(pixels - astronaut.pixels).mean() > 0.01

    def test_light_of_another_portrait(self, astronaut):
        """A portrait lit like itself stays what it is, but for what first-order light cannot say."""
        try:
            image = graphface.load("relight-like").run(photo=astronaut, reference=astronaut)["image"]
        except graphface.RunError as error:
            pytest.skip(str(error))
        assert np.abs(image.pixels - astronaut.pixels).mean() < 0.02
