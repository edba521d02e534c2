"""Relight pictures by lights that are known: the shipped graph, and the same with one thing changed.

Results are written as `score.py` reads them; the figures here are the same ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UsageError, load
from graphface.errors import did_you_mean, nearest_names
from graphface.evaluate.session import Session
from graphface.nodes.bench.known_light_cases import Case
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.color import decode_srgb
from graphface.nodes.io.image_write import write_image
from graphface.nodes.types import FloatArray, Image, Scene
from graphface.values.writing import make_folder

UNCHANGED = "unchanged photo"

_WINDOW = 7
"""Pixels to a side of SSIM's windows."""


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
    Variant("solids behind the face", replace={"face/head": "render.head"}),
    Variant("no head behind the face", replace={"face/head": "render.head"}, set={"face/head.solids": False}),
    Variant("light by plain least squares", set={"face/light.robust": "none"}),
    Variant("light by Huber's fit", set={"face/light.robust": "huber"}),
    Variant("normals of the fitted head", set={"face/refined.strength": 0.0}),
    Variant("cast shadows of the photo left in", set={"face/estimated.strength": 0.0}),
    Variant("light by the face alone", set={"face/light_mask.beyond": 0.0}),
    Variant("shading not below 0.15", set={"face/intrinsic.floor": 0.15}),
    Variant("second-order SH", set={"face/light.order": 2}),
    Variant("scatter.gaussian 0.03", replace={"scatter": "scatter.gaussian"}, scene={"scatter": 0.03}),
    Variant("scatter.screen_space 0.03", scene={"scatter": 0.03}),
    Variant("no highlights", scene={"specular": 0.0}),
    Variant("highlights 1", scene={"specular": 1.0}),
    Variant("detail.additive", replace={"face/detail": "detail.additive"}),
    Variant("detail.multiplicative", replace={"face/detail": "detail.multiplicative"}),
    Variant("detail.none", replace={"face/detail": "detail.none"}),
    Variant("geometry.average", replace={"face/mesh": "geometry.average"}),
    Variant("geometry.facemesh", replace={"face/mesh": "geometry.facemesh"}),
    Variant("linear values", set={"face/working.encoding": "linear"}),
)


def chosen_variants(names: Sequence[str] | None) -> list[Variant]:
    """The variants of these names, all of them for `["all"]`; the shipped graph by default.

    Raises:
        UsageError: there is no such variant.
    """
    known = {v.name: v for v in VARIANTS}
    asked = list(known) if names == ["all"] else names or [VARIANTS[0].name]
    for name in asked:
        if name not in known:
            raise UsageError(f"unknown variant {name!r}{did_you_mean(nearest_names(name, known))}")
    return [known[name] for name in asked]


@dataclass(frozen=True)
class Figure:
    """`psnr`, `si_psnr` in dB, `rmse`, `si_mse`, `ssim` over the compared pixels.

    `milliseconds` of CPU for a change of the light once the photo is represented; None for the unchanged photo.
    """

    variant: str
    subject: str
    light: str
    measured: dict[str, float]
    milliseconds: float | None = None


def relight_known(cases: Iterable[Case], variants: Sequence[Variant], out: Path | None = None) -> Iterator[Figure]:
    """Relight every case by every variant; the cases of a subject follow each other.

    Args:
        out: where pictures go: SUBJECT/LIGHT.png, in a folder named as the variant where there are several.

    Yields:
        For each subject the figures of the unchanged photo, then those of the variants, light by light.
    """
    for _, own in groupby(cases, lambda case: case.subject):
        subject = list(own)
        for case in subject:
            before = case.photo.pixels[_inside(case)]
            yield Figure(UNCHANGED, case.subject, case.light, compared(before, case.truth, case.mask))
        yield from _relit_subject(subject, variants, out)


def compared(result: FloatArray, truth: FloatArray, mask: FloatArray) -> dict[str, float]:
    """The figures of `score.py`; of the picture only what they depend on is looked at."""
    from skimage.metrics import structural_similarity

    part = _around(mask > 0.5)
    inside = (mask > 0.5)[part]
    a, b = result[part].astype(np.float64), truth[part].astype(np.float64)
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


def _relit_subject(cases: Sequence[Case], variants: Sequence[Variant], out: Path | None) -> Iterator[Figure]:
    """One subject, light by light: variants find what they share in memory, and nothing else has to be kept."""
    evaluator = MeteredEvaluator()
    photo = cases[0].photo
    sessions = []
    for variant in variants:
        graph = load("relight", replace=variant.replace, set=variant.set)
        sessions.append(Session(graph, {"photo": photo}, evaluator=evaluator, history=1))
    made: list[list[tuple[dict[str, float], bytes]]] = [[] for _ in variants]
    for case in cases:
        for variant, session, own in zip(variants, sessions, made, strict=True):
            pixels = _relit(session, case, variant)
            own.append((compared(pixels, case.truth, case.mask), evaluator.key("image")))
            if out is not None:
                folder = (out if len(variants) == 1 else out / variant.name) / case.subject
                make_folder(folder)
                write_image(Image(pixels), folder / f"{case.light}.png")
    for variant, own in zip(variants, made, strict=True):
        keys = [key for _, key in own]
        for place, (case, (measured, key)) in enumerate(zip(cases, own, strict=True)):
            spent = evaluator.cpu_ms(key, given=keys[:place] + keys[place + 1 :])
            yield Figure(variant.name, case.subject, case.light, measured, spent)


def _relit(session: Session, case: Case, variant: Variant) -> FloatArray:
    """The relit photo in the truth's encoding and frame, values in [0, 1]."""
    known = session.render(["face.mask", "face.normals"])
    on_face = (known["face.mask"] > 0.5) & np.any(known["face.normals"] != 0, axis=2)
    session.edit(scene=variant.applied(case.scene(known["face.normals"][on_face])))
    image: Image = session.render(["image"])["image"]
    shown = np.clip(image.pixels, 0, 1)[_inside(case)]
    return np.asarray(decode_srgb(shown) if case.photo.encoding == "linear" else shown, np.float32)


def _around(inside: NDArray[np.bool_]) -> tuple[slice, slice]:
    """The rows and columns that hold a mask, and the windows of SSIM about it."""
    rows, columns = (np.flatnonzero(inside.any(axis=axis)) for axis in (1, 0))
    if rows.size == 0:
        return slice(None), slice(None)
    return (
        slice(max(int(rows[0]) - _WINDOW, 0), int(rows[-1]) + 1 + _WINDOW),
        slice(max(int(columns[0]) - _WINDOW, 0), int(columns[-1]) + 1 + _WINDOW),
    )


def _inside(case: Case) -> tuple[slice, slice]:
    """The part of the photo that is compared."""
    kept = slice(case.crop, -case.crop or None)
    return kept, kept
