"""Pictures under known lights, in the form of the ground truth."""

from __future__ import annotations

import json

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.bench.heads import LIGHTS
from graphface.nodes.bench.known_light_cases import YALE_LIGHTS, head_cases, yale_cases, yale_scene
from graphface.nodes.io.image_write import write_picture
from graphface.nodes.render.irradiance import irradiance

FORWARD = np.float32([[0, 0, 1]])


def grey(path, value, shape=(30, 24)):
    path.parent.mkdir(parents=True, exist_ok=True)
    write_picture(np.full((*shape, 3), value, np.uint8), path)


@pytest.fixture
def drawn(tmp_path):
    """Two heads without faces, for what needs none: every light another grey, the face label on the left half."""
    for head in ("gt01", "gt02"):
        folder = tmp_path / "truth" / head
        for value, light in enumerate(LIGHTS):
            grey(folder / f"{light}.png", 100 + 10 * value)
        label = np.zeros((30, 24, 3), np.uint8)
        label[:, :12, 1] = 255
        write_picture(label, folder / "labels.png")
        front = {
            "ambient": 0.0,
            "area": [{"direction": [0, 0, 1], "half_size": 10, "distance": 100, "radiance": [5] * 3}],
        }
        lights = {light: {"ambient": 1.0, "area": []} for light in LIGHTS[1:]}
        (folder / "meta.json").write_text(json.dumps({"lights": {"frontal": front, **lights}}))
    return tmp_path


@pytest.fixture
def people(tmp_path):
    """Three people under the frontal light and some others."""
    for person in ("yaleB01", "yaleB02", "yaleB03"):
        for value, light in enumerate(("A+000E+00", *YALE_LIGHTS[:3])):
            grey(tmp_path / "yaleb" / person / f"{person}_P00{light}.png", 80 + 40 * value)
    return tmp_path


class TestHeadCases:
    def test_every_head_under_every_light(self, drawn):
        """From `frontal` to each of the others, in order, head by head."""
        cases = list(head_cases(drawn))
        assert [(c.subject, c.light) for c in cases] == [(h, light) for h in ("gt01", "gt02") for light in LIGHTS[1:]]
        for place, case in enumerate(cases[: len(LIGHTS) - 1]):
            assert case.photo.pixels[0, 0, 0] == pytest.approx(100 / 255)
            assert case.truth[0, 0, 0] == pytest.approx((110 + 10 * place) / 255)

    def test_from_another_light(self, drawn):
        """To all but that one; irradiance is in the unit of the light that the photo is in."""
        cases = list(head_cases(drawn, "ambient"))[: len(LIGHTS) - 1]
        assert [case.light for case in cases] == [light for light in LIGHTS if light != "ambient"]
        assert cases[0].photo.pixels[0, 0, 0] == pytest.approx((100 + 10 * LIGHTS.index("ambient")) / 255)
        np.testing.assert_allclose(irradiance(cases[0].scene(FORWARD), FORWARD), 0.2 / np.pi, rtol=1e-5)

    def test_compared_over_the_face_label(self, drawn):
        """The mask is the green of labels.png."""
        mask = next(head_cases(drawn)).mask
        assert (mask[:, :12] == 1).all()
        assert (mask[:, 12:] == 0).all()

    def test_in_the_photos_unit(self, drawn):
        """Irradiance 1 is the frontal light's on the face: 5 * (2 * 10 / 100)^2 = 0.2; the other lights' is pi."""
        scene = next(head_cases(drawn)).scene(FORWARD)
        np.testing.assert_allclose(irradiance(scene, FORWARD), np.pi / 0.2, rtol=1e-5)

    def test_no_heads(self, tmp_path):
        """A folder without heads is named."""
        with pytest.raises(UnreadableFile, match="truth"):
            next(head_cases(tmp_path))


class TestYaleCases:
    def test_the_lights_that_are_there(self, people):
        """Some people lack some photographs; those that exist are taken."""
        cases = [c for c in yale_cases(people) if c.subject == "yaleB02"]
        assert [c.light for c in cases] == list(YALE_LIGHTS[:3])
        assert cases[1].truth[0, 0, 0] == pytest.approx(160 / 255)

    def test_every_nth_person(self, people):
        """Counted from the first."""
        assert list(dict.fromkeys(c.subject for c in yale_cases(people, 2))) == ["yaleB01", "yaleB03"]

    def test_from_another_light(self, people):
        """From a light of the side to the frontal one and the others; whoever lacks the photograph is left out."""
        (people / "yaleb" / "yaleB01" / "yaleB01_P00A+025E+00.png").unlink()
        cases = list(yale_cases(people, source="A+025E+00"))
        assert [c.subject for c in cases] == ["yaleB02"] * 3 + ["yaleB03"] * 3
        assert [c.light for c in cases[:3]] == ["A+000E+00", *YALE_LIGHTS[1:3]]
        unit = float(irradiance(yale_scene("A+025E+00"), FORWARD).mean())
        assert cases[0].scene(FORWARD).lights[0].intensity == pytest.approx(1 / unit)

    def test_the_border_goes_away_again(self, people):
        """The photo is padded for the detector by what `crop` takes off; the whole crop is compared."""
        case = next(yale_cases(people))
        height, width = case.truth.shape[:2]
        assert case.photo.pixels.shape[:2] == (height + 2 * case.crop, width + 2 * case.crop)
        assert case.mask.shape == (height, width)
        assert case.mask.all()

    def test_nobody(self, tmp_path):
        """A folder without people is named."""
        with pytest.raises(UnreadableFile, match="yaleb"):
            next(yale_cases(tmp_path))


class TestYaleScene:
    @pytest.mark.parametrize("name", [*YALE_LIGHTS, "A+000E+00"])
    def test_direction(self, name):
        """As measured from the photographs: L = (-sin A cos E, sin E, cos A cos E)."""
        (lamp,) = yale_scene(name).lights
        a, e = np.radians(float(name[1:5])), np.radians(float(name[6:9]))
        np.testing.assert_allclose(lamp.towards, [-np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)], atol=1e-6)

    def test_unit(self):
        """The frontal light in its own unit lights what faces it with 1."""
        unit = float(irradiance(yale_scene("A+000E+00"), FORWARD).mean())
        np.testing.assert_allclose(irradiance(yale_scene("A+000E+00", unit), FORWARD), 1, rtol=1e-5)
