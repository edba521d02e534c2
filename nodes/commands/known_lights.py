"""Relight pictures by lights that are known, with the shipped graph and with parts of it changed.

Two sets of ground truth: path-traced heads (`truth/`) and photographs under one light at a time (`yaleb/`, Georghiades
et al. 2001; Lee et al. 2005). Results are written as `score.py` reads them; the figures here are the same ones.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from graphface import UnreadableFile
from graphface.nodes.color import decode_srgb
from graphface.nodes.commands.heads import heads_of
from graphface.nodes.commands.truth import LIGHTS, known_scene
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_image
from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.types import DirectionalLight, FloatArray, Image, Scene
from graphface.values.writing import make_folder

if TYPE_CHECKING:
    from graphface import Evaluator, Graph

YALE_LIGHTS = (
    *("A+025E+00", "A-025E+00", "A+050E+00", "A-050E+00"),
    *("A+070E+00", "A-070E+00", "A+000E+45", "A+000E-20"),
)
_FRONTAL = "A+000E+00"
_BORDER = 96
"""Pixels put around the Yale crops, which are too tight for a face detector."""

_ROOM = 0.03
"""Ambient share of the Yale light stage, from the darkest shadows; its lamps are about 2 degrees to the edge."""


@dataclass(frozen=True)
class Variant:
    """The relight graph with something changed; `scene` overrides what the known light says."""

    name: str
    replace: Mapping[str, str] = field(default_factory=dict)
    set: Mapping[str, Any] = field(default_factory=dict)
    scene: Mapping[str, Any] = field(default_factory=dict)
    shadow: str = "soft"

    def applied(self, scene: Scene) -> Scene:
        lights = tuple(light.model_copy(update={"shadow": self.shadow}) for light in scene.lights)
        return scene.model_copy(update={"hair": 0.0, **self.scene, "lights": lights})


VARIANTS = (
    Variant("as shipped"),
    Variant("no shadows", shadow="none"),
    Variant("hard shadows", shadow="hard"),
    Variant("no head behind the face", set={"face/head.solids": False}),
    Variant("light by plain least squares", set={"face/light.robust": "none"}),
    Variant("second-order SH", set={"face/light.order": 2}),
    Variant("scatter.gaussian 0.03", replace={"scatter": "scatter.gaussian"}, scene={"scatter": 0.03}),
    Variant("scatter.screen_space 0.03", scene={"scatter": 0.03}),
    Variant("highlights 1", scene={"specular": 1.0}),
    Variant("detail.additive", replace={"face/detail": "detail.additive"}),
    Variant("detail.multiplicative", replace={"face/detail": "detail.multiplicative"}),
    Variant("detail.none", replace={"face/detail": "detail.none"}),
    Variant("geometry.average", replace={"face/mesh": "geometry.average"}),
    Variant("geometry.morphable", replace={"face/mesh": "geometry.morphable"}),
)


@dataclass(frozen=True)
class Case:
    """One picture and what it should become: `compare` takes the relit pixels (linear for Yale) to figures."""

    subject: str
    light: str
    photo: Image
    scene: Callable[[FloatArray], Scene]
    """From the face's normals (n, 3) to the scene in the photo's unit."""
    truth: FloatArray
    mask: FloatArray
    crop: int = 0


@dataclass(frozen=True)
class Figure:
    """`psnr`, `si_psnr` in dB, `rmse`, `si_mse`, `ssim` over the compared pixels.

    `unchanged` has the same five of the photo as it is; `milliseconds` are from the representation on.
    """

    subject: str
    light: str
    measured: dict[str, float]
    unchanged: dict[str, float]
    milliseconds: float


def relight_known(cases: Iterator[Case], out: Path | None, variant: Variant, *, linear: bool) -> Iterator[Figure]:
    """Relight every case; write `out`/SUBJECT/LIGHT.png where `out` is given.

    Args:
        linear: the photos' values are linear light, and so are the ones compared.
    """
    from graphface import Evaluator, MemoryTier, load

    working = {"face/working.encoding": "linear"} if linear else {}
    graph = load("relight", replace=variant.replace, set={**working, **variant.set})
    subject, evaluator = None, Evaluator(memory=MemoryTier())
    for case in cases:
        if case.subject != subject:
            subject, evaluator = case.subject, Evaluator(memory=MemoryTier())
        image, milliseconds = _relit(graph, evaluator, case, variant)
        inside = np.s_[case.crop : -case.crop or None, case.crop : -case.crop or None]
        result = np.clip(image.pixels, 0, 1)[inside]
        before = case.photo.pixels[inside]
        if linear:
            result = decode_srgb(result)
        if out is not None:
            make_folder(out / case.subject)
            write_image(Image(np.asarray(result, np.float32)), out / case.subject / f"{case.light}.png")
        yield Figure(
            case.subject,
            case.light,
            compared(result, case.truth, case.mask),
            compared(before, case.truth, case.mask),
            milliseconds,
        )


def truth_cases(data: Path) -> Iterator[Case]:
    """The path-traced heads of `data`/truth, from `frontal` to every other light, compared over the face label."""
    heads = heads_of(data)
    for head in heads:
        lights = json.loads((head / "meta.json").read_text(encoding="utf-8"))["lights"]
        photo = read_image(head / "frontal.png")
        mask = (read_image(head / "labels.png").pixels[..., 1] > 0.5).astype(np.float32)
        for light in LIGHTS:

            def scene(normals: FloatArray, light: str = light, lights: Any = lights) -> Scene:
                unit = float(irradiance(known_scene(lights["frontal"]), normals).mean())
                return known_scene(lights[light], max(unit, 1e-6))

            yield Case(head.name, light, photo, scene, read_image(head / f"{light}.png").pixels, mask)


def yale_cases(data: Path, every: int = 1) -> Iterator[Case]:
    """The people of `data`/yaleb (every n-th), from the frontal light to eight others, compared over the whole crop."""
    import cv2

    people = sorted(path for path in (data / "yaleb").glob("yaleB*") if path.is_dir())[::every]
    if not people:
        raise UnreadableFile(data / "yaleb", "holds no people (folders yaleB01 ...)")
    for person in people:
        pixels = read_image(person / f"{person.name}_P00{_FRONTAL}.png").pixels
        sides = (_BORDER,) * 4
        padded = np.asarray(cv2.copyMakeBorder(pixels, *sides, cv2.BORDER_REPLICATE), np.float32)
        photo = Image(padded, encoding="linear")
        for light in YALE_LIGHTS:
            path = person / f"{person.name}_P00{light}.png"
            if not path.exists():
                continue

            def scene(normals: FloatArray, light: str = light) -> Scene:
                unit = float(irradiance(yale_scene(_FRONTAL), normals).mean())
                return yale_scene(light, max(unit, 1e-6))

            truth = read_image(path).pixels
            yield Case(person.name, light, photo, scene, truth, np.ones(truth.shape[:2], np.float32), _BORDER)


def yale_scene(name: str, unit: float = 1.0) -> Scene:
    """A light of the Yale stage by its name, A azimuth E elevation; positive azimuths are to the picture's left."""
    azimuth, elevation = float(name[1:5]), float(name[6:9])
    lamp = DirectionalLight(azimuth=-azimuth, elevation=elevation, size=2, intensity=1 / unit)
    return Scene(ambient=_ROOM / unit, lights=(lamp,), keep_mean=False, background=1)


def compared(result: FloatArray, truth: FloatArray, mask: FloatArray) -> dict[str, float]:
    """The figures of `score.py`."""
    from skimage.metrics import structural_similarity

    inside = mask > 0.5
    a, b = result.astype(np.float64), truth.astype(np.float64)
    gain = float((a * b)[inside].sum()) / max(float((a * a)[inside].sum()), 1e-12)
    mse, si_mse = (float(np.square(g * a - b)[inside].mean()) for g in (1.0, gain))
    similarity = structural_similarity(a, b, data_range=1, channel_axis=2, full=True)[1]  # type: ignore[no-untyped-call]
    return {
        "psnr": -10 * np.log10(max(mse, 1e-12)),
        "si_psnr": -10 * np.log10(max(si_mse, 1e-12)),
        "rmse": float(np.sqrt(mse)),
        "si_mse": si_mse,
        "ssim": float(similarity[inside].mean()),
    }


def _relit(graph: Graph, evaluator: Evaluator, case: Case, variant: Variant) -> tuple[Image, float]:
    """The relit photo, and the milliseconds it took once the representation was there."""
    known = graph.run(["face.mask", "face.normals", "face.detail"], evaluator=evaluator, photo=case.photo)
    on_face = (known["face.mask"] > 0.5) & np.any(known["face.normals"] != 0, axis=2)
    scene = variant.applied(case.scene(known["face.normals"][on_face]))
    start = time.perf_counter()
    image: Image = graph.run(["image"], evaluator=evaluator, photo=case.photo, scene=scene)["image"]
    return image, 1e3 * (time.perf_counter() - start)
