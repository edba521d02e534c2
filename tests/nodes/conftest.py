"""What the tests of face operators share."""

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
from graphface.nodes.bench.heads import LIGHTS
from graphface.nodes.color import decode_srgb
from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.io.image_write import write_picture
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import FloatArray, Image, Landmarks, Mesh, Surface


@pytest.fixture
def rng() -> np.random.Generator:
    """A random generator that is the same in every run."""
    return np.random.default_rng(7)


Face = tuple[Image, Landmarks, Mesh, Surface]


def texture(points: FloatArray, size: int, frequency: float = 7.0) -> FloatArray:
    """A smooth pattern of the picture's own coordinates, H x W x 3 in 0.2..0.8."""
    y, x = np.mgrid[:size, :size].astype(np.float32) / size
    waves = [np.sin(frequency * (x * a + y * b)) for a, b in ((3, 1), (1, 3), (2, -2))]
    return (0.5 + 0.3 * np.stack(waves, axis=2)).astype(np.float32)


@pytest.fixture
def make_face() -> Callable[..., Face]:
    """A face in a square picture: its size, how far it is turned (degrees), how it is scaled and moved."""

    def make(size: int = 160, yaw: float = 0.0, scale: float = 0.4, shift: tuple[float, float] = (0, 0)) -> Face:
        angle = np.radians(yaw)
        turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
        shape = facemesh_topology().mean @ turn.T * (scale * size)
        points = shape * (1, -1, 1) + (size / 2 + shift[0], size / 2 + shift[1], 0)
        landmarks = Landmarks(points.astype(np.float32), "facemesh468")
        photo = Image(texture(points, size))
        mesh = facemesh(landmarks)
        return photo, landmarks, mesh, rasterize(mesh, photo)

    return make


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
    """Ground truth of one head in the form of `truth/`: what is lit from a side is brighter there, by two stops.

    Its normals are those of an ellipsoid, its albedo is the frontal photo; it has no 68 points.
    """
    head = tmp_path / "data/truth/gt01"
    head.mkdir(parents=True)
    across = np.clip((np.arange(128) - 64) / 24, -1, 1)[:, None]  # over the width of the face
    sides = {"left45": 2.0**-across, "right45": 2.0**across, "red_blue": 2.0 ** (-across * [1, 0, -1])}
    for light in LIGHTS:
        factor = sides.get(light, np.array(0.5))
        lit = face if light == "frontal" else np.clip(face * factor * 0.5, 0, 255)
        write_picture(np.rint(lit).astype(np.uint8), head / f"{light}.png")
    write_picture(np.uint8([0, 255, 0]) * ellipse()[..., None], head / "labels.png")
    y, x = np.mgrid[:128, :128]
    across, down = (x - 64) / 24, (y - 60) / 27
    inside = (1 - across**2 - down**2).clip(0)
    normal = np.stack([across, -down, np.sqrt(inside)], axis=2) * (inside > 0)[..., None]
    np.savez(head / "aov.npz", normal=normal, depth=70 - 2 * np.sqrt(inside), albedo=decode_srgb(face / 255))
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
