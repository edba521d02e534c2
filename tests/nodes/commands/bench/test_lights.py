"""`graphface bench lights` on one small head."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from graphface.nodes.bench.heads import LIGHTS
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture

RELIT = LIGHTS[1:]


class TestBenchLights:
    @pytest.mark.parametrize(
        ("options", "words"),
        [
            (("--variant", "no shadow"), "no shadows"),
            (("--truth", "head"), "heads or yale"),
            (("--source", "left54"), "expected frontal, left45"),
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
        relit = {light: read_image(out / "gt01" / f"{light}.png").pixels for light in RELIT}
        assert {p.shape for p in relit.values()} == {(128, 128, 3)}
        left, right = np.s_[40:80, 42:60], np.s_[40:80, 68:86]
        assert (relit["left45"] - relit["right45"])[left].mean() > 0.05
        assert (relit["right45"] - relit["left45"])[right].mean() > 0.05
        assert (relit["red_blue"][..., 0] - relit["red_blue"][..., 2])[left].mean() > 0.1
        before, after = (said.figures(name) for name in ("unchanged photo", "as shipped"))
        assert (
            len(after) == len(before) + 1 == len(RELIT) + 3
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
        theirs = {cells[0]: float(cells[3]) for line in scored.splitlines() if (cells := line.split())[0] in RELIT}
        ours = dict(zip(RELIT, map(float, said.figures("no shadows")), strict=False))
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
