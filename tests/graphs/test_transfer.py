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
