"""graphs/makeup.yaml on photographs."""

import cv2
import numpy as np
import pytest

from graphface import load

pytestmark = pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")


class TestMakeup:
    @pytest.mark.parametrize("name", ["pd_roy-blunt.jpg", "pd_raul-grijalva.jpg"])  # the second: glasses and a beard
    def test_a_face_onto_itself(self, shared, name):
        """Self-transfer of the whole albedo returns the photo within 2/255."""
        photo = shared / "faces" / name
        made = load("makeup", variants=["paper"]).run(["image", "pair.working"], photo=photo, reference=photo)
        assert np.abs(made["image"].pixels - made["pair.working"].pixels).max() <= 2 / 255

    def test_every_picture_of_the_figure(self, shared):
        """Albedos, rendered shading, detail maps and masks come out by name; without detail, painted is rendered."""
        faces = shared / "faces"
        names = ["input_albedo", "reference_albedo", "albedo", "shading", "rendered", "input_detail", "detail", "keep"]
        names += ["reference_detail", "reference_warped", "core", "coverage", "painted", "image"]
        made = load("makeup").run(names, photo=faces / "nm_sm1.jpg", reference=faces / "wild_csd00012.jpg")
        core = made["core"] > 0.9
        plain = np.clip(made["painted"].pixels - made["detail"].offset, 0, 1)
        assert np.median(np.abs(plain - made["rendered"].pixels)[core]) < 1e-3

    def test_the_own_brows_stay(self, shared):
        """Over greasepaint with drawn brows the photo's own brows are as dark against their surroundings as before."""
        faces = shared / "faces"
        asked = ["image", "pair.working", "pair.features"]
        made = load("makeup").run(asked, photo=faces / "nm_sm1.jpg", reference=faces / "wild_sm1.jpg")
        brows = made["pair.features"].brows > 0.6
        ring = (made["pair.features"].brows < 0.1) & (cv2.dilate(brows.astype(np.uint8), np.ones((15, 15))) > 0)
        contrast = [
            np.log(v.pixels[brows].mean() + 0.05) - np.log(v.pixels[ring].mean() + 0.05)
            for v in (made["image"], made["pair.working"])
        ]
        assert contrast[0] < 0.5 * contrast[1] < 0

    def test_no_strength_no_change(self, shared):
        """Strength 0 returns the input to the last bit."""
        faces = shared / "faces"
        graph = load("makeup", set={"coverage.strength": 0})
        made = graph.run(["image", "pair.working"], photo=faces / "nm_sm1.jpg", reference=faces / "wild_sm1.jpg")
        np.testing.assert_array_equal(made["image"].pixels, made["pair.working"].pixels)
