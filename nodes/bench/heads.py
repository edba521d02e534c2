"""Path-traced heads: photographs under known lights, with the true normals, depth, albedo and labels."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile
from graphface.nodes.io.image_read import read_image
from graphface.nodes.types import DirectionalLight, FloatArray, Image, Mask, Normals, Scene

LIGHTS = ("frontal", "left45", "right45", "top", "left80_hard", "ambient", "red_blue")
"""Under which each head was traced: LIGHT.png in its folder. The first is the photo that is relit."""

LABELS = ("face", "hair", "background")
"""In the order of `Head.labels`."""


@dataclass(frozen=True)
class Head:
    """One head: a folder with a picture for each light, meta.json, labels.png and aov.npz. Read when asked for."""

    folder: Path

    @property
    def name(self) -> str:
        return self.folder.name

    def path(self, light: str = LIGHTS[0]) -> Path:
        """The photo under a light."""
        return self.folder / f"{light}.png"

    def photo(self, light: str = LIGHTS[0]) -> Image:
        """The photo under a light, sRGB-encoded."""
        return read_image(self.path(light))

    @cached_property
    def lights(self) -> dict[str, Any]:
        """Light to its constant `ambient` radiance and its square `area` lights."""
        found: dict[str, Any] = self._meta["lights"]
        return found

    @cached_property
    def points68(self) -> NDArray[np.float64] | None:
        """The true iBUG points (68, 2) in pixels, where the head has them."""
        points = self._meta.get("landmarks68")
        return None if points is None else np.asarray(points, np.float64)

    @cached_property
    def labels(self) -> FloatArray:
        """Soft labels H x W x 3 in the order of `LABELS`: green in labels.png is face, red is hair."""
        pixels = read_image(self.folder / "labels.png").pixels
        face, hair = pixels[..., 1], pixels[..., 0]
        return np.stack([face, hair, np.maximum(1 - face - hair, 0)], axis=2)

    @cached_property
    def face(self) -> Mask:
        """1 on the face label (with ears and neck), 0 elsewhere, H x W."""
        return (self.labels[..., 0] > 0.5).astype(np.float32)

    @cached_property
    def normals(self) -> Normals:
        """Unit vectors in the camera frame, H x W x 3."""
        return self._maps["normal"]

    @cached_property
    def albedo(self) -> FloatArray:
        """Linear reflectance, H x W x 3."""
        return self._maps["albedo"]

    @cached_property
    def depth(self) -> FloatArray:
        """Distance from the camera in centimetres, H x W."""
        return self._maps["depth"]

    @cached_property
    def _meta(self) -> dict[str, Any]:
        found: dict[str, Any] = json.loads((self.folder / "meta.json").read_text(encoding="utf-8"))
        return found

    @cached_property
    def _maps(self) -> dict[str, FloatArray]:
        with np.load(self.folder / "aov.npz") as maps:
            return {name: maps[name].astype(np.float32) for name in ("normal", "albedo", "depth")}


def heads_of(data: Path) -> list[Head]:
    """The heads of `data`/truth, by name.

    Raises:
        UnreadableFile: there are none.
    """
    found = sorted(path.parent for path in (data / "truth").glob("*/meta.json"))
    if not found:
        raise UnreadableFile(data / "truth", "holds no heads (folders with a meta.json)")
    return [Head(folder) for folder in found]


def known_scene(light: dict[str, Any], unit: float = 1.0) -> Scene:
    """A light of `Head.lights` as a scene; irradiances are divided by `unit`.

    An area light becomes a directional one, the ambient radiance a constant: what the scene model can say. Light
    between surfaces is in the truth and not in the answer.
    """
    lights = []
    for area in light["area"]:
        solid_angle = _solid_angle(area)
        color = tuple(solid_angle * radiance / unit for radiance in area["radiance"])
        size = np.degrees(np.arctan2(area["half_size"], area["distance"]))
        lights.append(DirectionalLight(direction=tuple(area["direction"]), color=color, size=size))
    ambient = np.pi * light["ambient"] / unit
    return Scene(ambient=ambient, lights=tuple(lights), keep_mean=False, background=1)


def true_direction(light: dict[str, Any]) -> FloatArray:
    """Sum over area lights of solid angle times radiance times direction; float32 (3,), not normalized."""
    total = np.zeros(3)
    for area in light["area"]:
        total += _solid_angle(area) * float(np.mean(area["radiance"])) * np.asarray(area["direction"], np.float64)
    return total.astype(np.float32)


def _solid_angle(area: dict[str, Any]) -> float:
    """Of a small square light, in steradians."""
    return float((2 * area["half_size"] / area["distance"]) ** 2)
