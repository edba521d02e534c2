"""The face commands called in this process, on a face small enough to be quick and a ground truth made of it."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from graphface.assets.asset import AssetUnavailable
from graphface.cli import main
from graphface.nodes.commands.truth import LIGHTS
from graphface.nodes.io.image_write import write_picture

Picture = NDArray[np.uint8]


@dataclass
class Said:
    """What a command answered."""

    code: int
    out: str
    err: str

    def figures(self, first: str) -> list[str]:
        """What stands in the table's row behind its first cell."""
        (line,) = (line for line in self.out.splitlines() if line.startswith(f"{first}  "))
        return line[len(first) :].split()


Command = Callable[..., Said]


@pytest.fixture
def command(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Command:
    """Runs `graphface ...` and tells exit code and output; a traceback fails the test."""
    monkeypatch.setenv("COLUMNS", "250")

    def run(*arguments: object) -> Said:
        with pytest.raises(SystemExit) as left:
            main([str(a) for a in arguments])
        out, err = capsys.readouterr()
        assert "Traceback" not in err
        return Said(int(left.value.code or 0), out, err)

    return run


@pytest.fixture(scope="session")
def networks() -> None:
    """For tests that look for faces: skips them where the networks cannot be had."""
    from graphface.nodes.landmarks.weights import BLAZEFACE, weights_path

    try:
        weights_path(BLAZEFACE)
    except AssetUnavailable as error:
        pytest.skip(str(error))


@pytest.fixture(scope="session")
def face(networks: None) -> Picture:
    """A face that the networks find, uint8 128 x 128 x 3."""
    import cv2

    photo = pytest.importorskip("skimage.data").astronaut()[:256, 96:352]
    return np.asarray(cv2.resize(photo, (128, 128), interpolation=cv2.INTER_AREA), np.uint8)


@pytest.fixture
def heads(face: Picture, tmp_path: Path) -> Path:
    """Ground truth of one head in the form of `truth/`: what is lit from a side is brighter there, by two stops."""
    head = tmp_path / "data/truth/gt01"
    head.mkdir(parents=True)
    across = np.clip((np.arange(128) - 64) / 24, -1, 1)[:, None]  # over the width of the face
    sides = {"left45": 2.0**-across, "right45": 2.0**across, "red_blue": 2.0 ** (-across * [1, 0, -1])}
    for light in ("frontal", *LIGHTS):
        factor = sides.get(light, np.array(0.5))
        lit = face if light == "frontal" else np.clip(face * factor * 0.5, 0, 255)
        write_picture(np.rint(lit).astype(np.uint8), head / f"{light}.png")
    write_picture(np.uint8([0, 255, 0]) * ellipse()[..., None], head / "labels.png")
    (head / "meta.json").write_text(json.dumps({"lights": area_lights()}))
    return tmp_path / "data"


def ellipse() -> Picture:
    """Where the face of `face` is: 1 inside, 0 outside."""
    y, x = np.mgrid[:128, :128]
    return (((x - 64) / 24) ** 2 + ((y - 60) / 27) ** 2 < 1).astype(np.uint8)


def area_lights() -> dict[str, object]:
    """The lights of a head's `meta.json`."""

    def lit(ambient: float, *areas: tuple[list[float], list[float]]) -> dict[str, object]:
        placed = [{"direction": d, "half_size": 20, "distance": 100, "radiance": r} for d, r in areas]
        return {"ambient": ambient, "area": placed}

    white, side = [6.0, 6.0, 6.0], 0.7
    return {
        "frontal": lit(0.1, ([0, 0, 1], white)),
        "left45": lit(0.1, ([-side, 0, side], white)),
        "right45": lit(0.1, ([side, 0, side], white)),
        "top": lit(0.1, ([0, side, side], white)),
        "left80_hard": lit(0.02, ([-0.98, 0, 0.17], white)),
        "red_blue": lit(0.05, ([-side, 0, side], [6.0, 0.5, 0.5]), ([side, 0, side], [0.5, 0.5, 6.0])),
        "ambient": lit(0.3),
    }
