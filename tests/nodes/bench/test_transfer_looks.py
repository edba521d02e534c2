"""Transfers as cases for a scorer of visible defects, and what is seen of them."""

from __future__ import annotations

import numpy as np
import pytest

from graphface import load
from graphface.nodes.bench.transfer_looks import transfer_looks
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture

pytestmark = pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")


@pytest.fixture(scope="module")
def looks(face, tmp_path_factory):
    """One photo onto itself, and a reference that is no photo."""
    folder = tmp_path_factory.mktemp("looks")
    write_picture(face, folder / "me.png")
    (folder / "none.png").write_text("no picture")
    references = [folder / "none.png", folder / "me.png"]
    return list(transfer_looks([folder / "me.png"], references, load("makeup"), folder / "out", 160)), folder / "out"


class TestTransferLooks:
    def test_a_case_for_each_pair(self, looks):
        """What cannot be read is left out; a case has everything that a scorer reads, all of one size."""
        found, out = looks
        assert [(look.photo, look.reference) for look in found] == [("me", "me")]
        case = out / "me_from_me"
        names = ("photo", "result", "face", "hair", "background", "warped", "known")
        sizes = {(i.width, i.height) for i in (read_image(case / f"{name}.png") for name in names)}
        assert len(sizes) == 1
        assert np.load(case / "points.npy").shape == (468, 3)

    def test_a_photo_onto_itself(self, looks):
        """Its skin stays, nothing changes beyond the face, and the lips keep their hue."""
        (look,) = looks[0]
        assert look.skin < 2
        assert look.outside < 0.2
        assert not look.lips > 5
        assert look.untouched > 0.3
