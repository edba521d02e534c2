"""What a surface receives from the lights of a scene."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from graphface import UsageError
from graphface.nodes.harmonics import basis, rotated
from graphface.nodes.types import (
    DirectionalLight,
    EnvironmentLight,
    FloatArray,
    HarmonicLight,
    Lighting,
    PointLight,
    Scene,
    SpotLight,
)
from graphface.nodes.types.lights import Casting


def irradiance(
    scene: Scene,
    normals: NDArray[np.float32],
    points: FloatArray | None = None,
    visible: Mapping[int, FloatArray] | None = None,
    panorama: Lighting | None = None,
) -> FloatArray:
    """What unit normals (n, 3) receive: (n,), or (n, 3) where a light is colored. Never negative.

    Args:
        points: (n, 3), inter-ocular distances from the middle of the face; near lights need them, without them
            everything counts as being at the middle.
        visible: share (n,) of a light that arrives, by its place in `scene.lights`; others arrive whole.
        panorama: the irradiance of environment lights, before they are turned.

    Raises:
        UsageError: the scene has an environment light and there is no panorama.
    """
    channels = 3 if scene.colored else 1
    ambient = scene.ambient if scene.colored else np.mean(scene.ambient)
    total = np.zeros((len(normals), channels), np.float32) + np.asarray(ambient, np.float32)
    for index, light in enumerate(scene.lights):
        if isinstance(light, HarmonicLight):
            received = _harmonic(light.values, normals)
        elif isinstance(light, EnvironmentLight):
            received = _surroundings(light, normals, panorama)
        else:
            received = arriving(light, normals, points)
            if visible is not None and index in visible:
                received *= visible[index]
            received = received[:, None]
        total += received * light.radiance[:channels]
    return total if scene.colored else total[:, 0]


def arriving(light: Casting, normals: NDArray[np.float32], points: FloatArray | None) -> FloatArray:
    """Cosine, cone and fall-off of a light of intensity 1, before shadows: (n,)."""
    reach = float(np.sin(np.radians(light.size)))
    if isinstance(light, DirectionalLight):
        return _wrapped_cosine(normals @ light.towards, reach)
    distance, towards = _to_light(light, normals, points)
    received = _wrapped_cosine(np.einsum("nc,nc->n", normals, towards), reach) * light.reach(distance)
    return received * _opened(light, towards) if isinstance(light, SpotLight) else received


def towards_light(light: Casting, normals: NDArray[np.float32], points: FloatArray | None) -> FloatArray:
    """Unit vectors to a light, (n, 3)."""
    if isinstance(light, DirectionalLight):
        return np.broadcast_to(light.towards, normals.shape)
    return _to_light(light, normals, points)[1]


def _surroundings(light: EnvironmentLight, normals: NDArray[np.float32], panorama: Lighting | None) -> FloatArray:
    if not light.radiance.any():
        return np.zeros((len(normals), 1), np.float32)
    if panorama is None:
        raise UsageError("the scene has an environment light; give the graph's input `environment` a panorama")
    return _harmonic(rotated(panorama, azimuth=light.azimuth).coefficients, normals)


def _harmonic(values: FloatArray, normals: NDArray[np.float32]) -> FloatArray:
    order = round(float(np.sqrt(len(values)))) - 1
    received: FloatArray = np.maximum(basis(normals, order) @ values, 0).astype(np.float32)
    return received if received.ndim == 2 else received[:, None]


def _to_light(
    light: PointLight, normals: NDArray[np.float32], points: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """Distance (n,) and unit vector (n, 3) from each point to the lamp."""
    away = light.place - (points if points is not None else np.zeros_like(normals))
    distance = np.sqrt(np.einsum("nc,nc->n", away, away))
    return distance, away / np.maximum(distance, np.float32(1e-4))[:, None]


def _wrapped_cosine(cosine: FloatArray, reach: float) -> FloatArray:
    """Lambert's max(0, cos) for a light of some size: rounded where the surface hides a part of the light.

    Within `reach` (the sine of the light's angle) of grazing, a parabola that meets 0 and the cosine without a kink. At
    grazing it gives a quarter of `reach`; a uniform disc gives 2 / (3 pi) of it, nearly the same.
    """
    reach = max(float(reach), 1e-4)
    partly = np.square(np.maximum(cosine + np.float32(reach), 0)) / np.float32(4 * reach)
    return np.where(cosine < reach, partly, cosine)


def _opened(light: SpotLight, towards: FloatArray) -> FloatArray:
    """1 within the cone, falling smoothly to 0 over the penumbra."""
    off_axis = np.degrees(np.arccos(np.clip(-(towards @ light.axis), -1, 1)))
    t = np.clip((light.cone + light.penumbra - off_axis) / max(light.penumbra, 0.1), 0, 1)
    return np.asarray(t * t * (3 - 2 * t), np.float32)
