"""Intrinsic methods and light fits on path-traced heads, whose albedo, normals and lights are known.

Methods work on sRGB-encoded pictures, as in the shipped graphs; their maps are decoded before they are compared, since
for a power law the encoded albedo is the encoding of the albedo.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from graphface.nodes.color import decode_srgb
from graphface.nodes.commands.heads import heads_of
from graphface.nodes.io.image_read import read_image
from graphface.nodes.metrics import light_angle, lmse, si_mse
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask, Normals

LIGHTS = ("frontal", "left45", "right45", "top", "left80_hard", "ambient")
DIRECTED = ("left45", "right45", "top", "left80_hard")
_LEAST = 1e-3


@dataclass(frozen=True)
class IntrinsicFigure:
    """Errors over the face label (see `graphface.nodes.metrics`), and the method's time on a 512 x 512 photo."""

    method: str
    head: str
    light: str
    albedo_si_mse: float
    albedo_lmse: float
    shading_si_mse: float
    shading_lmse: float
    milliseconds: float


@dataclass(frozen=True)
class LightFigure:
    """Degrees between the direction of the light found and the true one, by the mesh's and by the true normals."""

    order: int
    robust: str
    head: str
    light: str
    mesh_degrees: float
    true_degrees: float
    milliseconds: float


@dataclass(frozen=True)
class Head:
    folder: Path
    label: Mask
    albedo: FloatArray
    normals: Normals
    lights: dict[str, Any]

    def photo(self, light: str) -> Image:
        return read_image(self.folder / f"{light}.png")


def intrinsic_truth(
    data: Path, methods: dict[str, Callable[[Image], Intrinsic]], lights: Sequence[str] = LIGHTS
) -> Iterator[IntrinsicFigure]:
    """Every method on every head and light.

    Raises:
        UnreadableFile: there are no heads at `data`/truth.
    """
    for head in heads(data):
        for light in lights:
            photo = head.photo(light)
            linear = decode_srgb(photo.pixels)
            shading = linear.mean(axis=2) / np.maximum(head.albedo.mean(axis=2), _LEAST)
            mask = head.label * (head.albedo.mean(axis=2) > _LEAST)
            for name, method in methods.items():
                start = time.perf_counter()
                parts = method(photo)
                seconds = time.perf_counter() - start
                albedo, found = decode_srgb(parts.albedo), decode_srgb(parts.shading)
                yield IntrinsicFigure(
                    method=name,
                    head=head.folder.name,
                    light=light,
                    albedo_si_mse=si_mse(albedo, head.albedo, mask),
                    albedo_lmse=lmse(albedo, head.albedo, mask),
                    shading_si_mse=si_mse(found, shading, mask),
                    shading_lmse=lmse(found, shading, mask),
                    milliseconds=seconds * 1e3,
                )


def light_truth(
    data: Path, orders: Sequence[int] = (1, 2, 3), robust: Sequence[str] = ("none", "huber", "trimmed")
) -> Iterator[LightFigure]:
    """`sh.fit` of every order and robustness on every head under lights that come from somewhere.

    The true direction is that of the summed irradiance vectors of the area lights.

    Raises:
        UnreadableFile: there are no heads at `data`/truth.
    """
    from graphface.nodes.geometry.facemesh import facemesh as build_mesh
    from graphface.nodes.intrinsic.intensity import intensity
    from graphface.nodes.landmarks.facemesh import facemesh as find_landmarks
    from graphface.nodes.masks.face import face as face_mask
    from graphface.nodes.sh.fit import fit
    from graphface.nodes.surface.rasterize import rasterize

    for head in heads(data):
        frontal = head.photo("frontal")
        landmarks = find_landmarks(frontal)
        surface = rasterize(build_mesh(landmarks), frontal)
        mask = face_mask(surface, landmarks)
        for light in DIRECTED:
            shading = decode_srgb(intensity(head.photo(light)).shading)
            towards = true_direction(head.lights[light])
            for order in orders:
                for how in robust:
                    start = time.perf_counter()
                    found = fit(shading, surface.normals, mask, order=order, robust=how)  # type: ignore[arg-type]
                    seconds = time.perf_counter() - start
                    exact = fit(shading, head.normals, mask, order=order, robust=how)  # type: ignore[arg-type]
                    yield LightFigure(
                        order=order,
                        robust=how,
                        head=head.folder.name,
                        light=light,
                        mesh_degrees=light_angle(found.direction, towards),
                        true_degrees=light_angle(exact.direction, towards),
                        milliseconds=seconds * 1e3,
                    )


def heads(data: Path) -> Iterator[Head]:
    """The heads at `data`/truth.

    Raises:
        UnreadableFile: there are none.
    """
    found = heads_of(data)
    for folder in found:
        with np.load(folder / "aov.npz") as maps:
            normals, albedo = (maps[name].astype(np.float32) for name in ("normal", "albedo"))
        label = (read_image(folder / "labels.png").pixels[..., 1] > 0.5).astype(np.float32)
        lights = json.loads((folder / "meta.json").read_text(encoding="utf-8"))["lights"]
        yield Head(folder, label, albedo, normals, lights)


def true_direction(light: dict[str, Any]) -> FloatArray:
    """Sum over area lights of solid angle times radiance times direction; float32 (3,), not normalized."""
    total = np.zeros(3)
    for area in light["area"]:
        solid_angle = (2 * area["half_size"] / area["distance"]) ** 2
        total += solid_angle * float(np.mean(area["radiance"])) * np.asarray(area["direction"], np.float64)
    return total.astype(np.float32)
