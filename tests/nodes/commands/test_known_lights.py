"""`graphface bench lights`: cases in the form of the ground truth, the figures, and the command on one small head."""

from __future__ import annotations

import json
import subprocess
import sys

import numpy as np
import pytest

from graphface import UnreadableFile
from graphface.nodes.commands.known_lights import (
    VARIANTS,
    YALE_LIGHTS,
    Case,
    Variant,
    compared,
    relight_known,
    truth_cases,
    yale_cases,
    yale_scene,
)
from graphface.nodes.commands.truth import LIGHTS
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture
from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.types import DirectionalLight, Image, Scene
from graphface.nodes.types.image import image_from_array

FORWARD = np.float32([[0, 0, 1]])


def grey(path, value, shape=(30, 24)):
    path.parent.mkdir(parents=True, exist_ok=True)
    write_picture(np.full((*shape, 3), value, np.uint8), path)


@pytest.fixture
def drawn(tmp_path):
    """Two heads without faces, for what needs none: every light another grey, the face label on the left half."""
    for head in ("gt01", "gt02"):
        folder = tmp_path / "truth" / head
        for value, light in enumerate(("frontal", *LIGHTS)):
            grey(folder / f"{light}.png", 100 + 10 * value)
        label = np.zeros((30, 24, 3), np.uint8)
        label[:, :12, 1] = 255
        write_picture(label, folder / "labels.png")
        front = {
            "ambient": 0.0,
            "area": [{"direction": [0, 0, 1], "half_size": 10, "distance": 100, "radiance": [5] * 3}],
        }
        lights = {light: {"ambient": 1.0, "area": []} for light in LIGHTS}
        (folder / "meta.json").write_text(json.dumps({"lights": {"frontal": front, **lights}}))
    return tmp_path


@pytest.fixture
def people(tmp_path):
    """Three people under the frontal light and some others."""
    for person in ("yaleB01", "yaleB02", "yaleB03"):
        for value, light in enumerate(("A+000E+00", *YALE_LIGHTS[:3])):
            grey(tmp_path / "yaleb" / person / f"{person}_P00{light}.png", 80 + 40 * value)
    return tmp_path


class TestTruthCases:
    def test_every_head_under_every_light(self, drawn):
        """From `frontal` to each of the others, in order, head by head."""
        cases = list(truth_cases(drawn))
        assert [(c.subject, c.light) for c in cases] == [(h, light) for h in ("gt01", "gt02") for light in LIGHTS]
        for place, case in enumerate(cases[: len(LIGHTS)]):
            assert case.photo.pixels[0, 0, 0] == pytest.approx(100 / 255)
            assert case.truth[0, 0, 0] == pytest.approx((110 + 10 * place) / 255)

    def test_compared_over_the_face_label(self, drawn):
        """The mask is the green of labels.png."""
        mask = next(truth_cases(drawn)).mask
        assert (mask[:, :12] == 1).all()
        assert (mask[:, 12:] == 0).all()

    def test_in_the_photos_unit(self, drawn):
        """Irradiance 1 is the frontal light's on the face: 5 * (2 * 10 / 100)^2 = 0.2; the other lights' is pi."""
        scene = next(truth_cases(drawn)).scene(FORWARD)
        np.testing.assert_allclose(irradiance(scene, FORWARD), np.pi / 0.2, rtol=1e-5)

    def test_no_heads(self, tmp_path):
        """A folder without heads is named."""
        with pytest.raises(UnreadableFile, match="truth"):
            next(truth_cases(tmp_path))


class TestYaleCases:
    def test_the_lights_that_are_there(self, people):
        """Some people lack some photographs; those that exist are taken."""
        cases = [c for c in yale_cases(people) if c.subject == "yaleB02"]
        assert [c.light for c in cases] == list(YALE_LIGHTS[:3])
        assert cases[1].truth[0, 0, 0] == pytest.approx(160 / 255)

    def test_every_nth_person(self, people):
        """Counted from the first."""
        assert list(dict.fromkeys(c.subject for c in yale_cases(people, 2))) == ["yaleB01", "yaleB03"]

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


class TestVariant:
    SCENE = Scene(lights=(DirectionalLight(azimuth=10), DirectionalLight(azimuth=-10)), scatter=0.1, hair=0.5)

    def test_shadow_of_every_light(self):
        """One kind of shadow for all lights, and hair without the old light."""
        scene = Variant("x", shadow="none").applied(self.SCENE)
        assert [light.shadow for light in scene.lights] == ["none", "none"]
        assert [light.azimuth for light in scene.lights] == [10, -10]
        assert scene.hair == 0

    def test_scene_override(self):
        """What the variant says of the scene wins; the rest is the known light's."""
        scene = Variant("x", scene={"specular": 2.0}).applied(self.SCENE)
        assert (scene.specular, scene.scatter) == (2.0, 0.1)

    def test_names_are_unique(self):
        """A name tells one variant."""
        assert len({v.name for v in VARIANTS}) == len(VARIANTS)


class TestCompared:
    @pytest.fixture
    def pair(self, rng):
        truth = rng.uniform(0.2, 0.8, (40, 40, 3)).astype(np.float32)
        return truth, np.ones((40, 40), np.float32)

    def test_offset(self, pair):
        """An error of 0.1 everywhere is 20 dB and a root mean square of 0.1."""
        truth, mask = pair
        found = compared(truth + np.float32(0.1), truth, mask)
        assert found["psnr"] == pytest.approx(20, abs=1e-3)
        assert found["rmse"] == pytest.approx(0.1, abs=1e-5)

    def test_exposure_is_forgiven(self, pair):
        """The scale-invariant figures know one best gain, the others none."""
        truth, mask = pair
        found = compared(truth / 2, truth, mask)
        assert found["si_mse"] < 1e-12
        assert found["si_psnr"] > 100
        assert found["psnr"] < 15

    def test_only_inside_the_mask(self, pair):
        """What happens outside does not count, but for the windows of SSIM that reach there."""
        truth, mask = pair
        mask[:, 20:] = 0
        spoilt = truth.copy()
        spoilt[:, 30:] = 0
        found = compared(spoilt, truth, mask)
        assert found["rmse"] == 0
        assert found["ssim"] == pytest.approx(1)

    def test_perfect_and_black_are_finite(self, pair):
        """No figure is infinite, whatever the pictures."""
        truth, mask = pair
        for one, other in ((truth, truth), (truth * 0, truth), (truth, truth * 0), (truth * 0, truth * 0)):
            assert np.isfinite(list(compared(one, other, mask).values())).all()


class TestRelightKnown:
    @pytest.mark.parametrize("linear", [False, True])
    def test_the_photos_own_light(self, face, tmp_path, linear):
        """A scene that changes nothing gives the photo, in the values it is compared in, without its border."""
        inner = image_from_array(face).pixels[8:-8, 8:-8]
        photo = Image(np.float32(face / 255), encoding="linear" if linear else "srgb")
        case = Case("me", "own", photo, lambda normals: Scene(mode="add"), inner, np.ones(inner.shape[:2]), crop=8)
        (figure,) = relight_known(iter([case]), tmp_path, VARIANTS[0], linear=linear)
        assert figure.measured["rmse"] == pytest.approx(0, abs=1e-6)
        assert figure.unchanged["rmse"] == 0
        np.testing.assert_array_equal(np.rint(read_image(tmp_path / "me/own.png").pixels * 255), face[8:-8, 8:-8])


class TestBenchLights:
    @pytest.mark.parametrize(
        ("options", "words"),
        [
            (("--variant", "no shadow"), "no shadows"),
            (("--truth", "head"), "heads or yale"),
            (("--data", "nowhere"), "holds no heads"),
            (("--truth", "yale", "--data", "nowhere"), "holds no people"),
        ],
    )
    def test_wrong_request(self, command, options, words):
        """Nothing is run, and the message says what there is."""
        said = command("bench", "lights", *options)
        assert said.code == 2
        assert words in said.err

    def test_one_variant(self, command, heads, tmp_path):
        """HEAD/LIGHT.png of the photo's size; the light comes from where meta.json says; figures beside the photo's."""
        out = tmp_path / "out"
        said = command("bench", "lights", out, "--data", heads)
        assert said.code == 0, said.err
        relit = {light: read_image(out / "gt01" / f"{light}.png").pixels for light in LIGHTS}
        assert {p.shape for p in relit.values()} == {(128, 128, 3)}
        left, right = np.s_[40:80, 42:60], np.s_[40:80, 68:86]
        assert (relit["left45"] - relit["right45"])[left].mean() > 0.05
        assert (relit["right45"] - relit["left45"])[right].mean() > 0.05
        assert (relit["red_blue"][..., 0] - relit["red_blue"][..., 2])[left].mean() > 0.1
        before, after = (said.figures(name) for name in ("unchanged photo", "as shipped"))
        assert (
            len(after) == len(before) + 1 == len(LIGHTS) + 3
        )  # mean and SSIM; milliseconds, which the photo takes none
        for column in (0, 1):  # lit from a side, as the truth is and the photo is not
            assert float(after[column]) > float(before[column])

    def test_agrees_with_the_scoring_script(self, command, heads, tmp_path, shared):
        """The figures are those of score.py, which shares no code with this, but for 8-bit rounding of the pictures."""
        script = shared.parent / "score.py"
        if not script.is_file():
            pytest.skip("needs score.py beside the shared data")
        said = command("bench", "lights", tmp_path / "out", "--data", heads, "--variant", "no shadows")
        call = [sys.executable, str(script), "relight", str(tmp_path / "out"), "--data", str(heads)]
        scored = subprocess.run(call, capture_output=True, text=True, check=False).stdout
        theirs = {cells[0]: float(cells[3]) for line in scored.splitlines() if (cells := line.split())[0] in LIGHTS}
        ours = dict(zip(LIGHTS, map(float, said.figures("no shadows")), strict=False))
        assert ours == pytest.approx(theirs, abs=0.05)

    def test_several_variants(self, command, heads, tmp_path):
        """A folder and a row for each, in the order asked for, and a sheet of the head beside the truth."""
        out = tmp_path / "out"
        names = ("detail.none", "no shadows")
        said = command("bench", "lights", out, "--data", heads, *(a for n in names for a in ("--variant", n)))
        assert said.code == 0, said.err
        assert said.out.index("unchanged photo") < said.out.index(names[0]) < said.out.index(names[1])
        assert {p.name for p in out.iterdir()} == {*names, "sheet-gt01.png"}
        one, other = (read_image(out / name / "gt01/left45.png").pixels for name in names)
        assert np.abs(one - other).max() > 0.05

    def test_yale(self, command, face, tmp_path):
        """Crops go in, crops of the same size come out, lit as the name of the light says."""
        import cv2

        crop = cv2.cvtColor(face[16:112, 24:104], cv2.COLOR_RGB2GRAY)
        folder = tmp_path / "data/yaleb/yaleB01"
        folder.mkdir(parents=True)
        for light in ("A+000E+00", "A+050E+00", "A-050E+00"):
            write_picture(np.repeat(crop[..., None], 3, axis=2), folder / f"yaleB01_P00{light}.png")
        said = command("bench", "lights", tmp_path / "out", "--data", tmp_path / "data", "--truth", "yale")
        assert said.code == 0, said.err
        results = tmp_path / "out/yaleB01"
        assert sorted(p.stem for p in results.iterdir()) == ["A+050E+00", "A-050E+00"]
        left_lit, right_lit = (read_image(results / f"A{a}E+00.png").pixels for a in ("+050", "-050"))
        assert left_lit.shape == (96, 80, 3)
        change = (left_lit - right_lit).mean(axis=2)[24:64]
        assert change[:, 20:36].mean() > 0.02
        assert change[:, 46:62].mean() < -0.02
        *errors, similarity = said.figures("unchanged photo")
        assert {float(e) for e in errors} == {0}  # here the truth is the photo itself
        assert float(similarity) == 1
