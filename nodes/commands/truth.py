"""Relight the path-traced heads by lights that are known, and compare with the path-traced answer.

The heads' `meta.json` gives each light as a constant ambient radiance plus square area lights. Here an area light
becomes a directional one and the ambient radiance a constant: what the scene model can say. Highlights, cast shadows
and light between surfaces are in the truth and not in the answer.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, Literal

import numpy as np

from graphface.nodes.blend.recombine import recombine
from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.commands.heads import heads_of
from graphface.nodes.geometry.facemesh import facemesh as build_mesh
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_image
from graphface.nodes.landmarks.facemesh import facemesh as find_landmarks
from graphface.nodes.masks.face import face as face_mask
from graphface.nodes.metrics import normal_angle, psnr, si_psnr
from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.render.samples import samples
from graphface.nodes.render.shade import shade
from graphface.nodes.render.spread import spread
from graphface.nodes.render.surroundings import surroundings
from graphface.nodes.sh.fit import fit as fit_light
from graphface.nodes.sh.render import render as render_light
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import DirectionalLight, Encoding, Image, Scene
from graphface.values.writing import make_folder

LIGHTS = ("left45", "right45", "top", "left80_hard", "red_blue", "ambient")

Method = Literal["additive", "multiplicative", "none", "split"]


@dataclass(frozen=True)
class Relit:
    """One head under one light: figures in dB over the face label, beside those of the unchanged photo."""

    head: str
    light: str
    psnr: float
    si_psnr: float
    unchanged_psnr: float
    unchanged_si_psnr: float
    normal_error: float
    """Mean angle between the mesh's normals and the true ones, degrees, where the mesh lies on the face label."""


def relight_truth(
    data: Path,
    out: Path,
    *,
    encoding: Encoding = "srgb",
    method: Method = "split",
    shoulder: float = 0.5,
    source: str = "frontal",
) -> Iterator[Relit]:
    """Relight every head of `data`/truth from one light to the others; write `out`/HEAD/LIGHT.png.

    Args:
        data: the folder that holds `truth`.
        out: made where it does not exist.
        encoding: of the values that albedo and shading live in.
        method: which detail map.
        shoulder: see `blend.recombine`.
        source: the light of the photo that is relit; the geometry is found in `frontal` whatever it is.

    Yields:
        One row for each picture, as it is written.

    Raises:
        UnreadableFile: there are no heads at `data`.
    """
    heads = heads_of(data)
    for head in heads:
        yield from _relight_head(head, out / head.name, encoding, method, shoulder, source)


def known_scene(light: dict[str, Any], unit: float = 1.0) -> Scene:
    """A light of `meta.json` as a scene; irradiances are divided by `unit`."""
    lights = []
    for area in light["area"]:
        solid_angle = (2 * area["half_size"] / area["distance"]) ** 2
        color = tuple(solid_angle * radiance / unit for radiance in area["radiance"])
        size = np.degrees(np.arctan2(area["half_size"], area["distance"]))
        lights.append(DirectionalLight(direction=tuple(area["direction"]), color=color, size=size))
    ambient = np.pi * light["ambient"] / unit
    return Scene(ambient=ambient, lights=tuple(lights), keep_mean=False, background=1)


def _relight_head(
    head: Path, out: Path, encoding: Encoding, method: Method, shoulder: float, source: str
) -> Iterator[Relit]:
    lights = json.loads((head / "meta.json").read_text(encoding="utf-8"))["lights"]
    frontal, taken = (read_image(head / f"{light}.png") for light in ("frontal", source))
    face_label = (read_image(head / "labels.png").pixels[..., 1] > 0.5).astype(np.float32)

    landmarks = find_landmarks(frontal)
    surface = rasterize(build_mesh(landmarks), frontal)
    normals = surface.normals
    mask = face_mask(surface, landmarks)
    photo = taken if encoding == "srgb" else taken.with_pixels(decode_srgb(taken.pixels), "linear")
    intrinsic = intensity(photo)
    estimated = render_light(fit_light(intrinsic.shading, normals, mask).light, normals)
    around, points = surroundings(mask, surface, landmarks), samples(surface, estimated, mask, photo)
    old = spread(estimated, around)
    detail_method = getattr(import_module(f"graphface.nodes.detail.{method}"), method)
    leftover = detail_method(photo, intrinsic.albedo, old)

    covered = surface.coverage > 0
    unit = float(np.average(irradiance(known_scene(lights[source]), normals[covered]), weights=mask[covered]))
    with np.load(head / "aov.npz") as maps:
        true_normals = maps["normal"].astype(np.float32)
    normal_error = normal_angle(normals, true_normals, face_label)

    make_folder(out)
    for light in LIGHTS if source == "frontal" else [name for name in ("frontal", *LIGHTS) if name != source]:
        scene = known_scene(lights[light], unit)
        new = spread(shade(points, scene, estimated), around)
        relit = recombine(photo, intrinsic.albedo, new, leftover, shoulder=shoulder)
        result = taken.with_pixels(relit.pixels if encoding == "srgb" else encode_srgb(relit.pixels))
        write_image(result, out / f"{light}.png")
        yield _compared(head, light, result, taken, face_label, normal_error)


def _compared(head: Path, light: str, result: Image, source: Image, mask: Any, normal_error: float) -> Relit:
    truth = read_image(head / f"{light}.png").pixels
    shown, before = np.clip(result.pixels, 0, 1), source.pixels
    return Relit(
        head=head.name,
        light=light,
        psnr=psnr(shown, truth, mask),
        si_psnr=si_psnr(shown, truth, mask),
        unchanged_psnr=psnr(before, truth, mask),
        unchanged_si_psnr=si_psnr(before, truth, mask),
        normal_error=normal_error,
    )
