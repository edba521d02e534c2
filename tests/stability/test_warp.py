"""Makeup and detail transfer on hard pairs: right results, or a clear error."""

import numpy as np
import pytest

import graphface
from graphface.assets.asset import AssetUnavailable
from graphface.nodes.types.image import image_from_array

pytestmark = pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")


@pytest.fixture(scope="module")
def astronaut():
    return pytest.importorskip("skimage.data").astronaut()[:300, 80:400]


def transferred(name, photo, reference, **choices):
    """The result, after it was checked for what every result must be."""
    try:
        graph = graphface.load(name, **choices)
        made = graph.run(["image", "pair.working"], photo=photo, reference=reference)
    except graphface.RunError as error:
        failures = [error.__cause__, *(f.__cause__ for f in getattr(error, "failures", []))]
        if any(isinstance(f, AssetUnavailable) for f in failures):
            pytest.skip(str(error))
        raise
    pixels = made["image"].pixels
    assert pixels.shape == made["pair.working"].pixels.shape
    assert np.isfinite(pixels).all()
    assert pixels.min() > -0.02
    assert pixels.max() < 1.02
    return made["image"].pixels, made["pair.working"].pixels


def shrunk(picture, width):
    import cv2

    height = round(picture.shape[0] * width / picture.shape[1])
    return cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA)


def grey(picture):
    return np.repeat(picture.mean(axis=2, keepdims=True).astype(np.uint8), 3, axis=2)


def cut(picture):
    return np.ascontiguousarray(picture[:, :175])


def dim(picture):
    return (picture * 0.12).astype(np.uint8)


def glaring(picture):
    return np.clip(picture.astype(int) * 2, 0, 255).astype(np.uint8)


def mirrored(picture):
    return np.ascontiguousarray(picture[:, ::-1])


HARD = [grey, cut, dim, glaring, mirrored]


@pytest.mark.parametrize("graph", ["makeup", "transfer"])
class TestHardPairs:
    @pytest.mark.parametrize("change", HARD)
    def test_reference(self, astronaut, graph, change):
        """A grey, cut, dim, overexposed or mirrored reference gives a picture in range."""
        transferred(graph, astronaut, change(astronaut))

    @pytest.mark.parametrize("change", HARD)
    def test_photo(self, astronaut, graph, change):
        """So does such a photo."""
        transferred(graph, change(astronaut), astronaut)

    def test_small_reference(self, astronaut, graph):
        """A reference of 60 pixels still has a face in it."""
        transferred(graph, astronaut, shrunk(astronaut, 60))

    def test_identical(self, astronaut, graph):
        """A photo onto itself comes back: the whole albedo, the whole detail."""
        choices = {"variants": ["paper"]} if graph == "makeup" else {}
        result, photo = transferred(graph, astronaut, astronaut, **choices)
        assert np.abs(result - photo).max() <= 2 / 255

    def test_no_face_is_said(self, astronaut, graph):
        """A reference without a face is an error that names its file or node, not a picture."""
        wall = image_from_array(np.full((64, 64, 3), 128, np.uint8))
        with pytest.raises(graphface.GraphfaceError, match="face"):
            transferred(graph, astronaut, wall)


class TestMakeup:
    def test_a_grey_reference_takes_the_colour(self, astronaut):
        """The paper's method moves skin: grey skin makes the face grey, its colourfulness falls below a third."""
        result, photo = transferred("makeup", astronaut, grey(astronaut), variants=["paper"])
        changed = np.abs(result - photo).max(axis=2) > 0.02
        saturation = [np.ptp(pixels[changed], axis=1).mean() for pixels in (result, photo)]
        assert saturation[0] < saturation[1] / 3

    def test_a_grey_reference_leaves_color(self, astronaut):
        """A black-and-white photo shows no pigment: as a layer it darkens, and the face keeps its color."""
        result, photo = transferred("makeup", astronaut, grey(astronaut))
        changed = np.abs(result - photo).max(axis=2) > 0.02
        saturation = [np.ptp(pixels[changed], axis=1).mean() for pixels in (result, photo)]
        assert saturation[0] > 0.6 * saturation[1]

    def test_what_is_worn_already_is_not_put_on_twice(self, astronaut):
        """The photo's own makeup over itself changes it by less than a grey level in the mean."""
        result, photo = transferred("makeup", astronaut, astronaut)
        change = np.abs(result - photo).max(axis=2)
        assert change.mean() < 1 / 255
        assert np.quantile(change, 0.99) < 20 / 255

    def test_bare_skin_stays(self, astronaut):
        """Where the reference wears nothing the photo stays to the last bit."""
        graph = graphface.load("makeup")
        asked = ["image", "pair.working", "pair.paint", "pair.core"]
        made = graph.run(asked, photo=astronaut, reference=mirrored(astronaut))
        bare = ~((made["pair.paint"].departure != 0).any(axis=2) | (made["pair.paint"].opacity > 0))
        np.testing.assert_array_equal(made["image"].pixels[bare], made["pair.working"].pixels[bare])
        assert bare[made["pair.core"] > 0.5].mean() > 0.2

    def test_half_strength_lies_between(self, astronaut):
        """Half the strength is half of the way."""
        full, photo = transferred("makeup", astronaut, glaring(astronaut))
        half, _ = transferred("makeup", astronaut, glaring(astronaut), set={"coverage.strength": 0.5})
        np.testing.assert_allclose(half, (full + photo) / 2, atol=2e-3)

    def test_no_strength(self, astronaut):
        """Strength 0 returns the input to the last bit."""
        result, photo = transferred("makeup", astronaut, grey(astronaut), set={"coverage.strength": 0})
        np.testing.assert_array_equal(result, photo)


class TestTransfer:
    def test_no_region(self, astronaut):
        """An empty list of regions returns the photo."""
        result, photo = transferred("transfer", astronaut, glaring(astronaut), set={"mask.take": []})
        assert np.abs(result - photo).max() < 1e-3
