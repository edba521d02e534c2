"""graphs/transfer.yaml on photographs."""

import numpy as np
import pytest

from graphface import load

pytestmark = pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")


class TestTransfer:
    @pytest.mark.parametrize("name", ["nm_sm1.jpg", "pd_raul-grijalva.jpg"])  # the second with glasses and a beard
    def test_a_face_onto_itself(self, shared, name):
        """All nine regions of a face onto itself return the photo within 2/255."""
        photo = shared / "faces" / name
        made = load("transfer").run(["image", "pair.working"], photo=photo, reference=photo)
        assert np.abs(made["image"].pixels - made["pair.working"].pixels).max() <= 2 / 255

    def test_only_what_was_asked_for(self, shared):
        """Taking the nose leaves every pixel off the nose as it is."""
        faces = shared / "faces"
        graph = load("transfer", set={"mask.take": ["nose"]})
        asked = ["image", "mask", "pair.working"]
        made = graph.run(asked, photo=faces / "nm_sm1.jpg", reference=faces / "pd_roy-blunt.jpg")
        change = np.abs(made["image"].pixels - made["pair.working"].pixels).max(axis=2)
        assert change[made["mask"] == 0].max() < 1e-3
        assert change[made["mask"] > 0.9].mean() > 0.01

    @pytest.mark.parametrize(
        "variant", ["older", "younger", "freckles", "shiny", "matte", "rough", "wrinkles", "paper"]
    )
    def test_presets(self, shared, variant):
        """Each changes the photo, within the face's mask and in finite values."""
        faces = shared / "faces"
        graph = load("transfer", variants=[variant])
        asked = ["image", "mask", "pair.working"]
        made = graph.run(asked, photo=faces / "nm_sm1.jpg", reference=faces / "pd_roy-blunt.jpg")
        change = np.abs(made["image"].pixels - made["pair.working"].pixels).max(axis=2)
        assert np.isfinite(change).all()
        assert change[made["mask"] == 0].max() < 1e-3
        assert change.max() > 0.02

    def test_skin_tone_stays(self, shared):
        """Pale skin's detail leaves dark skin as dark and as colored as it is."""
        faces = shared / "faces"
        asked = ["image", "mask", "pair.working"]
        made = load("transfer").run(asked, photo=faces / "pd_cedric-richmond.jpg", reference=faces / "pd_roy-blunt.jpg")
        inside = made["mask"] > 0.9
        before, after = (made[name].pixels[inside].mean(axis=0) for name in ("pair.working", "image"))
        np.testing.assert_allclose(after, before, rtol=0.06)
