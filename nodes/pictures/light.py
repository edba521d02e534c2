"""Light: a sphere under it, with an arrow to where most of it comes from; panoramas."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from graphface.nodes.color import encode_srgb
from graphface.nodes.environment import environment_light
from graphface.nodes.harmonics import Y_0, Y_1, basis
from graphface.nodes.pictures.maps import draw_shading
from graphface.nodes.pictures.photo import Pixels
from graphface.nodes.types import Direction, Environment, FloatArray, Lighting, LightingFit
from graphface.pictures.card import draw_text
from graphface.pictures.colors import as_bytes, with_odd
from graphface.pictures.text import font
from graphface.values.picture import Picture, View

_SIDE = 256
"""Pixels of a sphere, where the view does not say."""
_AROUND = 24
_ARROW = (255, 170, 40)


def draw_lighting(light: Lighting, view: View) -> Picture:
    """A white sphere under the light, and an arrow to its brightest side."""
    coefficients = light.coefficients
    if coefficients.shape[0] not in (1, 4, 9, 16):
        return draw_text(f"no light: {coefficients.shape[0]} coefficients", view)
    side = max(16, min(view.size or _SIDE, 512))
    pixels, shading, white = lit_sphere(light, side)
    _arrow(pixels, main_direction(light))
    channels = ("red", "green", "blue") if shading.ndim == 3 else ("shading",)
    return Picture(pixels, with_odd(_in_words(light, white), coefficients), shading, channels)


def draw_fit(fit: LightingFit, view: View) -> Picture:
    """What the light does not explain, with the sphere in a corner."""
    residual = draw_shading(fit.residual, view)
    pixels = residual.pixels.copy()
    side = max(16, min(pixels.shape[:2]) // 3)
    small, _, white = lit_sphere(fit.light, side)
    _arrow(small, fit.direction)
    if side <= min(pixels.shape[:2]):
        pixels[-side:, :side] = small
    words = _in_words(fit.light, white)
    note = f"residual: {residual.note}; in the corner {words}; condition {fit.condition:.3g}"
    return Picture(pixels, note, residual.data, residual.channels, residual.full)


def draw_direction(direction: Direction, view: View) -> Picture:
    """A sphere lit from there."""
    x, y, z = (float(value) for value in np.nan_to_num(direction))
    light = Lighting(np.array([0.25 / Y_0, 0.6 * y / Y_1, 0.6 * z / Y_1, 0.6 * x / Y_1], np.float32))
    pixels, _, _ = lit_sphere(light, max(16, min(view.size or _SIDE, 512)))
    _arrow(pixels, direction)
    numbers = ", ".join(f"{value:.3f}" for value in direction)
    return Picture(pixels, with_odd(f"{_where(direction)}; ({numbers})", direction))


def draw_environment(environment: Environment, view: View) -> Picture:
    """The panorama, and in a corner a matt sphere in its light."""
    seen = view.sampled(environment.radiance)
    full = (environment.radiance.shape[0], environment.radiance.shape[1])
    if not seen.size:
        return draw_text("an empty panorama", view)
    finite = np.nan_to_num(seen, posinf=0, neginf=0)
    white = max(1.0, 4 * float(finite.mean()))
    pixels = as_bytes(encode_srgb(np.asarray(seen / white, np.float32)))
    side = seen.shape[0] // 3
    note = f"linear radiance, white is {white:.3g}; the middle looks to the viewer"
    if side >= 16:
        light = environment_light(Environment(finite), 2)
        small, _, _ = lit_sphere(Lighting(light.coefficients / np.float32(white)), side, linear=True)
        pixels[-side:, :side] = small
        note += "; in the corner a matt sphere in this light"
    return Picture(pixels, with_odd(note, seen), seen, ("red", "green", "blue"), full)


def lit_sphere(light: Lighting, side: int, *, linear: bool = False) -> tuple[Pixels, FloatArray, float]:
    """A white sphere under a light: its picture, its shading (NaN beside it), and the shading that is white."""
    normals, inside = sphere_normals(side)
    values = basis(normals.reshape(-1, 3), light.order) @ np.asarray(light.coefficients, np.float64)
    shading = values.reshape(side, side, *light.coefficients.shape[1:]).astype(np.float32)
    shading[inside <= 0] = np.nan
    white = max(1.0, float(np.nanmax(np.nan_to_num(shading, posinf=0)))) if shading.size else 1.0
    shown = np.where(inside.reshape(inside.shape + (1,) * (shading.ndim - 2)) > 0, shading, 0) / np.float32(white)
    pixels = as_bytes(encode_srgb(np.maximum(shown, 0)) if linear else shown).astype(np.float32)
    cover = inside[..., None]
    return np.rint(pixels * cover + _AROUND * (1 - cover)).astype(np.uint8), shading, white


def main_direction(light: Lighting) -> FloatArray:
    """Unit vector to where most of a light comes from, by its first order; 0 where it is even."""
    if light.order < 1:
        return np.zeros(3, np.float32)
    first = light.coefficients[1:4]
    y, z, x = first.mean(axis=1) if first.ndim == 2 else first
    vector = np.array([x, y, z], np.float32)
    length = float(np.linalg.norm(vector))
    return vector / length if 1e-6 < length < np.inf else np.zeros(3, np.float32)


def sphere_normals(side: int) -> tuple[NDArray[np.float64], FloatArray]:
    """Normals and coverage of a sphere in a square."""
    at = (np.arange(side) + 0.5 - side / 2) / (side * 0.47)
    x, y = np.meshgrid(at, -at)
    distance = np.hypot(x, y)
    length = np.maximum(distance, 1)
    z = np.sqrt(np.maximum(1 - distance**2, 0))
    inside = np.clip((1 - distance) * side * 0.47 + 0.5, 0, 1).astype(np.float32)
    return np.stack([x / length, y / length, z], axis=2), inside


def _arrow(pixels: Pixels, towards: Direction) -> None:
    """An arrow from the sphere's middle to where the light comes from; a ring where it comes from the viewer's side."""
    if not np.isfinite(towards).all() or not np.any(towards):
        return
    side, middle = pixels.shape[0], pixels.shape[0] / 2
    reach = 0.45 * side
    tip = (round(middle + reach * float(towards[0])), round(middle - reach * float(towards[1])))
    width = max(1, side // 100)
    if np.hypot(tip[0] - middle, tip[1] - middle) > 0.08 * side:
        start = (round(middle), round(middle))
        cv2.arrowedLine(pixels, start, tip, _ARROW, width, cv2.LINE_AA, tipLength=0.2)
    else:
        cv2.circle(pixels, (round(middle), round(middle)), max(2, side // 16), _ARROW, width, cv2.LINE_AA)
    if towards[2] < 0 and side >= 64:
        pixels[:] = _captioned(pixels, "from behind")


def _captioned(pixels: Pixels, text: str) -> Pixels:
    from PIL import Image, ImageDraw

    canvas = Image.fromarray(pixels)
    ImageDraw.Draw(canvas).text((4, 2), text, _ARROW, font(max(9, pixels.shape[0] // 16)))
    return np.asarray(canvas)


def _in_words(light: Lighting, white: float) -> str:
    numbers = light.coefficients.mean(axis=1) if light.coefficients.ndim == 2 else light.coefficients
    first = ", ".join(f"{value:.3g}" for value in numbers[:4]) + (" ..." if len(numbers) > 4 else "")
    return f"a sphere under the light, white is {white:.3g}; {_where(main_direction(light))}; coefficients {first}"


def _where(towards: Direction) -> str:
    """A direction in words, as scene files have it."""
    if not np.isfinite(towards).all() or not np.any(towards):
        return "from no side more than from others"
    x, y, z = (float(value) for value in towards)
    azimuth, elevation = np.degrees(np.arctan2(x, z)), np.degrees(np.arcsin(np.clip(y, -1, 1)))
    return f"most comes from azimuth {azimuth:.0f}, elevation {elevation:.0f} degrees"
