"""`graphface bench looks`: what a scorer of visible defects reads, and the strength of the light."""

from __future__ import annotations

import math

import numpy as np
import pytest

from graphface import UsageError, load
from graphface.nodes.bench.relit_looks import relit_looks, rim_dip
from graphface.nodes.bench.shipped import scene_file
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture

pytestmark = pytest.mark.filterwarnings("ignore::graphface.GraphfaceWarning")

LEFT = "lights: [{type: directional, azimuth: -80, shadow: soft, size: 20}]\nambient: 0.2\n"
EVEN = "ambient: 1\n"


@pytest.fixture(scope="module")
def looks(face, tmp_path_factory):
    """One photo and one file that is no photo, under light from the left and under even light."""
    folder = tmp_path_factory.mktemp("looks")
    write_picture(face, folder / "me.png")
    (folder / "none.png").write_text("no picture")
    for name, text in (("left", LEFT), ("even", EVEN)):
        (folder / f"{name}.yaml").write_text(text)
    photos = [folder / "none.png", folder / "me.png"]
    scenes = [folder / "left.yaml", folder / "even.yaml"]
    found = list(relit_looks(photos, scenes, load("relight"), folder / "out", 100))
    return found, folder / "out"


class TestRelitLooks:
    def test_of_the_photos_size(self, face, tmp_path):
        """Where the graph works on a smaller copy, labels and points are those of the photo all the same."""
        write_picture(face, tmp_path / "me.png")
        (tmp_path / "left.yaml").write_text(LEFT)
        graph = load("relight", set={"face/working_size.resolution": 40})
        (look,) = relit_looks([tmp_path / "me.png"], [tmp_path / "left.yaml"], graph, tmp_path / "out", 512)
        assert 0 < look.cheeks < 0.8
        case = tmp_path / "out" / "left" / "me"
        sizes = {read_image(case / f"{name}.png").pixels.shape for name in ("photo", "result", "face")}
        assert len(sizes) == 1
        points, inside = np.load(case / "points.npy"), read_image(case / "face.png").pixels[..., 0]
        x, y = np.round(points[[4, 50, 280], :2]).astype(int).T
        assert inside[y, x].min() > 0.9

    def test_a_case_for_each_photo_and_scene(self, looks):
        """What cannot be read is left out."""
        assert [(look.photo, look.scene) for look in looks[0]] == [("me", "left"), ("me", "even")]

    @pytest.mark.parametrize("scene", ["left", "even"])
    def test_files(self, looks, scene):
        """The pictures agree in size; labels add up to one; there are the points of FaceMesh."""
        case = looks[1] / scene / "me"
        pictures = {name: read_image(case / f"{name}.png").pixels for name in ("photo", "result", "face", "hair")}
        pictures["background"] = read_image(case / "background.png").pixels
        assert {p.shape for p in pictures.values()} == {pictures["photo"].shape}
        assert max(pictures["photo"].shape) == 100
        total = sum(pictures[name] for name in ("face", "hair", "background"))
        np.testing.assert_allclose(total, 1, atol=0.02)
        assert len(np.load(case / "points.npy")) == 468

    def test_strength(self, looks):
        """The far cheek is darker; even light comes from no side."""
        left, even = looks[0]
        assert 0 < left.cheeks < 0.8
        assert math.isnan(even.cheeks)

    def test_rim(self, looks):
        """A share where a shadow is cast, else nothing."""
        left, even = looks[0]
        assert 0 <= left.rim < 0.2
        assert math.isnan(even.rim)


class TestRimDip:
    @pytest.fixture
    def landmarks(self, make_face):
        return make_face(size=300, scale=0.3)[1]

    @staticmethod
    def arc(landmarks, depth):
        """Light with a dark line at the top of the face mesh."""
        rows = np.arange(300, dtype=np.float32)[:, None] - landmarks.points[10, 1]
        return np.broadcast_to(1 - depth * np.exp(-np.square(rows / 4)), (300, 300)).astype(np.float32)

    @pytest.mark.parametrize("depth", [0.1, 0.5])
    def test_an_arc_is_found(self, landmarks, depth):
        """About as deep as it is."""
        found = rim_dip(self.arc(landmarks, depth), landmarks, np.ones((300, 300), np.float32))
        assert found == pytest.approx(depth, rel=0.15)

    def test_light_that_falls_off_is_no_dip(self, landmarks):
        """Darker towards the top, without a brighter side beyond."""
        slope = np.broadcast_to(np.linspace(0.2, 1, 300, dtype=np.float32)[:, None], (300, 300)).copy()
        assert rim_dip(slope, landmarks, np.ones((300, 300), np.float32)) < 0.01

    def test_beneath_hair_nothing_counts(self, landmarks):
        """No skin, no dip."""
        assert math.isnan(rim_dip(self.arc(landmarks, 0.5), landmarks, np.zeros((300, 300), np.float32)))


class TestSceneFile:
    def test_by_name_and_by_path(self, tmp_path):
        """Shipped scenes have names."""
        assert scene_file("candle").name == "candle.yaml"
        (tmp_path / "mine.yaml").write_text(EVEN)
        assert scene_file(str(tmp_path / "mine.yaml")) == tmp_path / "mine.yaml"

    def test_neither(self):
        """The nearest name is offered."""
        with pytest.raises(UsageError, match=r"candel.*candle"):
            scene_file("candel")
