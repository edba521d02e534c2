"""A scene as a diagram: the lamps around a head seen from above and from the side, and a matt ball in their light."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from graphface.nodes.color import encode_srgb
from graphface.nodes.harmonics import basis
from graphface.nodes.pictures.light import sphere_normals
from graphface.nodes.types import DirectionalLight, EnvironmentLight, HarmonicLight, PointLight, Scene, SpotLight
from graphface.pictures.colors import as_bytes
from graphface.pictures.text import font, write
from graphface.values.picture import Picture, View

_SIDE = 720
_PAPER, _INK, _FAINT, _HEAD = (32, 34, 40), (226, 226, 230), (96, 100, 110), (150, 140, 132)
_MOST = 21
"""Lines of text; more lights than that are drawn and not named."""
_NEAR = 2.0
"""Distance, in inter-ocular distances, that is drawn half way to the rim."""


def draw_scene(scene: Scene, view: View) -> Picture:
    """Two plans and a ball, and every light in words. Distances are shortened the more the farther out they are."""
    size = max(96, min(view.size or _SIDE, 1200))
    side, ball = size // 2, size // 4
    letters = max(8, min(20, size // 32))
    lines = _lines(scene)[:_MOST]
    canvas = Image.new("RGB", (size, side + max(ball + 4, letters * 3 // 2 * len(lines) + letters)), _PAPER)
    pen = ImageDraw.Draw(canvas)
    _plan(pen, scene, (0, 0, side), "from above", np.array([[1, 0, 0], [0, 0, 1]]), letters)
    _plan(pen, scene, (side, 0, side), "from the side", np.array([[0, 0, 1], [0, -1, 0]]), letters)
    canvas.paste(Image.fromarray(_ball(scene, ball)), (2, side))
    for row, (line, color) in enumerate(lines):
        top = side + letters // 2 + row * letters * 3 // 2
        if color is not None:
            pen.ellipse((ball + 8, top + 2, ball + 8 + letters * 0.7, top + 2 + letters * 0.7), color)
        write(pen, (ball + 12 + letters, top), line, letters, width=size - ball - letters - 16, color=_INK)
    note = "lamps around the head, distances shortened outwards; the ball has no shadows, irradiance 2 is white"
    note += "; without the panorama" if scene.surrounded else ""
    return Picture(np.asarray(canvas), note)


def _plan(
    pen: ImageDraw.ImageDraw, scene: Scene, at: tuple[int, int, int], title: str, axes: NDArray[Any], letters: int
) -> None:
    """One plan in a square at (left, top, side); `axes` takes the camera frame to the picture's right and down."""
    left, top, side = at
    middle = np.array([left + side / 2, top + side / 2 + letters / 2])
    rim = side * 0.38
    pen.ellipse((*(middle - rim), *(middle + rim)), outline=(58, 61, 70))
    radius = rim * 0.3
    pen.ellipse((*(middle - radius), *(middle + radius)), _HEAD)
    nose = axes @ np.array([0.0, -0.1, 1.25])
    base = np.array([-nose[1], nose[0]]) * 0.22
    corners = [middle + radius * nose, middle + radius * (0.8 * nose + base), middle + radius * (0.8 * nose - base)]
    pen.polygon([tuple(corner) for corner in corners], _HEAD)
    viewer = middle + axes @ np.array([0.0, 0.0, 1.0]) * rim * 1.13
    write(pen, (viewer[0] - letters * 0.55, viewer[1] - letters * 0.6), "cam", letters * 3 // 4, width=99, color=_FAINT)
    write(pen, (left + 4, top + 2), title, letters, width=side - 8, color=_INK)
    taken: list[NDArray[Any]] = []
    for number, light in enumerate(scene.lights):
        if isinstance(light, DirectionalLight | PointLight):
            place = light.towards * 1e6 if isinstance(light, DirectionalLight) else light.place
            spot = middle + rim * _shortened(axes @ np.asarray(place, np.float64), float(np.linalg.norm(place)))
            taken.append(_beside_others(spot, middle, taken, 2 * _lamp_radius(rim)))
            _lamp(pen, light, number, taken[-1], middle, rim, axes)


def _lamp_radius(rim: float) -> float:
    return max(3.0, rim * 0.07)


def _beside_others(spot: NDArray[Any], middle: NDArray[Any], taken: list[NDArray[Any]], apart: float) -> NDArray[Any]:
    """A lamp's place in a plan; beside lamps that are drawn there already, since seen from a side they may coincide."""
    out = spot - middle
    length = float(np.hypot(*out))
    across = np.array([-out[1], out[0]]) / length if length > 1e-6 else np.array([1.0, 0.0])
    while any(np.hypot(*(spot - other)) < apart for other in taken):
        spot = spot + across * apart
    return spot


def _lamp(
    pen: ImageDraw.ImageDraw,
    light: Any,
    number: int,
    spot: NDArray[Any],
    middle: NDArray[Any],
    rim: float,
    axes: NDArray[Any],
) -> None:
    color = lamp_color(light)
    target = np.zeros(3)
    if isinstance(light, SpotLight):
        target = np.asarray(light.target, np.float64)
        aim = middle + rim * _shortened(axes @ target, float(np.linalg.norm(target)))
        _cone(pen, spot, aim, light.cone, color)
    elif isinstance(light, DirectionalLight):
        along = middle - spot
        across = np.array([-along[1], along[0]]) * 0.12
        for shift in (-1, 0, 1):
            pen.line((*(spot + shift * across), *(spot + shift * across + 0.5 * along)), color)
    else:
        pen.line((*spot, *(spot + 0.5 * (middle - spot))), _FAINT)
    radius = _lamp_radius(rim)
    pen.ellipse((*(spot - radius), *(spot + radius)), color, outline=_INK)
    pen.text(tuple(spot), str(number + 1), (0, 0, 0), font(max(8, round(radius * 1.5))), anchor="mm")


def _shortened(at: NDArray[Any], distance: float) -> NDArray[np.float64]:
    """A position in a plan with the distance d drawn at d / (d + `_NEAR`) of the rim."""
    shown: NDArray[np.float64] = np.asarray(at, np.float64) / (distance + _NEAR)
    return shown


def _cone(pen: ImageDraw.ImageDraw, spot: NDArray[Any], aim: NDArray[Any], degrees: float, color: Any) -> None:
    along = aim - spot
    for sign in (-1, 1):
        angle = np.radians(sign * min(degrees, 80))
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        pen.line((*spot, *(spot + turn @ along)), color)


def lamp_color(light: Any) -> tuple[int, int, int]:
    """The light's own color, as bright as it can be shown."""
    radiance = np.asarray(light.radiance, np.float32)
    shown = encode_srgb(radiance / max(float(radiance.max()), 1e-6))
    red, green, blue = (int(v) for v in np.rint(np.clip(shown, 0.12, 1) * 255))
    return red, green, blue


def _ball(scene: Scene, side: int) -> NDArray[np.uint8]:
    """A matt ball of the head's size under ambient light, lamps and harmonics, without shadows."""
    normals, inside = sphere_normals(side)
    flat = normals.reshape(-1, 3)
    irradiance = np.zeros((len(flat), 3)) + np.asarray(scene.ambient)
    for light in scene.lights:
        irradiance += _irradiance(light, flat) * light.radiance
    shown = as_bytes(encode_srgb((irradiance.reshape(side, side, 3) * scene.exposure / 2).astype(np.float32)))
    cover = inside[..., None]
    return np.rint(shown * cover + np.array(_PAPER) * (1 - cover)).astype(np.uint8)


def _irradiance(light: Any, normals: NDArray[Any]) -> NDArray[Any]:
    """Of one light of radiance 1 on unit vectors (n, 3): (n, 1) or (n, 3)."""
    if isinstance(light, DirectionalLight):
        return np.maximum(normals @ light.towards, 0)[:, None]
    if isinstance(light, PointLight):
        offset = light.place - normals
        distance = np.linalg.norm(offset, axis=1)
        cosine = np.sum(offset * normals, axis=1) / np.maximum(distance, 1e-6)
        arrives = np.maximum(cosine, 0) * light.reach(distance.astype(np.float32))
        if isinstance(light, SpotLight):
            angle = np.degrees(np.arccos(np.clip((-offset @ light.axis) / np.maximum(distance, 1e-6), -1, 1)))
            arrives = arrives * np.clip((light.cone + light.penumbra - angle) / max(light.penumbra, 1e-3), 0, 1)
        return np.asarray(arrives[:, None])
    if isinstance(light, HarmonicLight):
        values = light.values
        order = round(float(np.sqrt(len(values)))) - 1
        lit = basis(normals, order) @ values
        return np.maximum(lit if lit.ndim == 2 else lit[:, None], 0)
    return np.zeros((len(normals), 1))


def _lines(scene: Scene) -> list[tuple[str, Any]]:
    """The scene in a line, and each of its lights in two, with the color of the lamp before the first."""
    ambient = scene.ambient if isinstance(scene.ambient, tuple) else (scene.ambient,)
    words = f"{scene.mode}, ambient {' '.join(f'{value:.3g}' for value in ambient)}"
    words += f", exposure {scene.exposure:.3g}" if scene.exposure != 1 else ""
    lines: list[tuple[str, Any]] = [(words, None)]
    for number, light in enumerate(scene.lights):
        casts = "" if isinstance(light, HarmonicLight | EnvironmentLight) else f", shadow {light.shadow}"
        lines.append((f"{number + 1} {light.type} {light.intensity:.3g}{casts}", lamp_color(light)))
        lines.append((_where(light), None))
    return lines


def _where(light: Any) -> str:
    if isinstance(light, HarmonicLight):
        return light.preset or f"{len(light.values)} coefficients"
    if isinstance(light, EnvironmentLight):
        return f"panorama turned by {light.azimuth:.0f}"
    place = light.towards if isinstance(light, DirectionalLight) else light.place
    x, y, z = (float(value) for value in place)
    distance = float(np.linalg.norm(place))
    azimuth = np.degrees(np.arctan2(x, z))
    elevation = np.degrees(np.arcsin(np.clip(y / max(distance, 1e-6), -1, 1)))
    away = "" if isinstance(light, DirectionalLight) else f", distance {distance:.3g}"
    cone = f", cone {light.cone:.0f}" if isinstance(light, SpotLight) else ""
    return f"azimuth {azimuth:.0f}, elevation {elevation:.0f}{away}{cone}"
