"""Pictures with what they become under another light: path-traced heads, and photographs taken under one light each.

The photographs are the cropped Extended Yale B (Georghiades et al. 2001; Lee et al. 2005).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from graphface import UnreadableFile
from graphface.nodes.bench.heads import LIGHTS, Head, heads_of, known_scene
from graphface.nodes.io.image_read import read_image
from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.types import DirectionalLight, FloatArray, Image, Scene

YALE_LIGHTS = (
    *("A+025E+00", "A-025E+00", "A+050E+00", "A-050E+00"),
    *("A+070E+00", "A-070E+00", "A+000E+45", "A+000E-20"),
)
YALE_FRONTAL = "A+000E+00"
_BORDER = 96
"""Pixels put around the Yale crops, which are too tight for a face detector."""

_GREY = 0.2
"""The linear value of those pixels. The crop's own edge continued outwards would look like skin in another light."""

_AMBIENT = 0.03
"""Ambient share of the Yale light stage, from the darkest shadows; its lamps are about 2 degrees to the edge."""

_LEAST_UNIT = 1e-6


@dataclass(frozen=True)
class Case:
    """One photo and what it should become.

    `scene` takes the face's normals (n, 3) to the known light in the photo's unit: mean irradiance 1 on the face under
    the light that the photo was taken in. `truth` H x W x 3 in the photo's encoding and `mask` H x W are those of the
    photo without `crop` pixels on each side.
    """

    subject: str
    light: str
    photo: Image
    scene: Callable[[FloatArray], Scene]
    truth: FloatArray
    mask: FloatArray
    crop: int = 0


def head_cases(data: Path, source: str = LIGHTS[0]) -> Iterator[Case]:
    """The path-traced heads of `data`/truth, from one light to every other, compared over the face label.

    Raises:
        UnreadableFile: there are no heads at `data`.
    """
    for head in heads_of(data):
        photo = head.photo(source)
        for light in LIGHTS:
            if light != source:
                scene = partial(_head_scene, head, source, light)
                yield Case(head.name, light, photo, scene, head.photo(light).pixels, head.face)


def yale_cases(data: Path, every: int = 1, source: str = YALE_FRONTAL) -> Iterator[Case]:
    """The people of `data`/yaleb (every n-th), from one light to the others, compared over the whole crop.

    Raises:
        UnreadableFile: there are no people at `data`.
    """
    people = sorted(path for path in (data / "yaleb").glob("yaleB*") if path.is_dir())[::every]
    if not people:
        raise UnreadableFile(data / "yaleb", "holds no people (folders yaleB01 ...)")
    for person in (p for p in people if (p / f"{p.name}_P00{source}.png").exists()):
        pixels = read_image(person / f"{person.name}_P00{source}.png").pixels
        padded = np.full((pixels.shape[0] + 2 * _BORDER, pixels.shape[1] + 2 * _BORDER, 3), _GREY, np.float32)
        padded[_BORDER:-_BORDER, _BORDER:-_BORDER] = pixels
        photo = Image(padded, encoding="linear")
        for light in (YALE_FRONTAL, *YALE_LIGHTS) if source != YALE_FRONTAL else YALE_LIGHTS:
            path = person / f"{person.name}_P00{light}.png"
            if path.exists() and light != source:
                truth = read_image(path).pixels
                everywhere = np.ones(truth.shape[:2], np.float32)
                yield Case(person.name, light, photo, partial(_yale_scene, source, light), truth, everywhere, _BORDER)


def yale_scene(name: str, unit: float = 1.0) -> Scene:
    """A light of the Yale stage by its name, A azimuth E elevation; positive azimuths are to the picture's left."""
    azimuth, elevation = float(name[1:5]), float(name[6:9])
    lamp = DirectionalLight(azimuth=-azimuth, elevation=elevation, size=2, intensity=1 / unit)
    return Scene(ambient=_AMBIENT / unit, lights=(lamp,), keep_mean=False, background=1)


def _head_scene(head: Head, source: str, light: str, normals: FloatArray) -> Scene:
    unit = float(irradiance(known_scene(head.lights[source]), normals).mean())
    return known_scene(head.lights[light], max(unit, _LEAST_UNIT))


def _yale_scene(source: str, light: str, normals: FloatArray) -> Scene:
    unit = float(irradiance(yale_scene(source), normals).mean())
    return yale_scene(light, max(unit, _LEAST_UNIT))
