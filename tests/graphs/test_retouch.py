"""graphs/retouch.yaml on photographs."""

import numpy as np
import pytest

from graphface import load

pytestmark = pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")


class TestRetouch:
    def test_nothing_asked_for(self, shared):
        """Without a variant the photo comes back."""
        made = load("retouch").run(["image", "face.working"], photo=shared / "faces" / "pd_roy-blunt.jpg")
        np.testing.assert_allclose(made["image"].pixels, made["face.working"].pixels, atol=1e-5)

    @pytest.mark.parametrize("variant", ["younger", "matte", "older", "shiny", "rough"])
    def test_presets(self, shared, variant):
        """Each changes skin and nothing else."""
        photo = shared / "faces" / "pd_roy-blunt.jpg"
        made = load("retouch", variants=[variant]).run(["image", "mask", "face.working"], photo=photo)
        change = np.abs(made["image"].pixels - made["face.working"].pixels).max(axis=2)
        assert change[made["mask"] == 0].max() < 1e-5
        assert change.max() > 0.03
