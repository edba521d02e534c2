"""The irradiance of a surface under the lights of a scene."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from graphface import UsageError
from graphface.nodes.harmonics import basis, rotated
from graphface.nodes.smoothstep import smoothstep
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
    """The sum of the irradiances of all lights, in linear light and in the photo's unit.

    Args:
        normals: (n, 3) unit vectors.
        points: (n, 3), inter-ocular distances from the middle of the face, for point and spot lights. None takes every
            point to be at the middle.
        visible: the visible share (n,) of a light, by its index in `scene.lights`; other lights are fully visible.
        panorama: the irradiance of environment lights, before their rotation.

    Returns:
        float32 (n,), or (n, 3) if the scene is colored; not negative.

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
            received = _environment(light, normals, panorama)
        else:
            received = unshadowed_irradiance(light, normals, points)
            if visible is not None and index in visible:
                received *= visible[index]
            received = received[:, None]
        total += received * light.radiance[:channels]
    return total if scene.colored else total[:, 0]


def unshadowed_irradiance(light: Casting, normals: NDArray[np.float32], points: FloatArray | None) -> FloatArray:
    """Cosine, cone and distance falloff of a light of intensity 1, without shadows: float32 (n,)."""
    sine = float(np.sin(np.radians(light.size)))
    if isinstance(light, DirectionalLight):
        return _wrapped_cosine(normals @ light.towards, sine)
    distance, towards = _distance_and_direction(light, normals, points)
    received = _wrapped_cosine(np.einsum("nc,nc->n", normals, towards), sine) * light.reach(distance)
    return received * _inside_cone(light, towards) if isinstance(light, SpotLight) else received


def directions_to_light(light: Casting, normals: NDArray[np.float32], points: FloatArray | None) -> FloatArray:
    """Unit vectors from each point to a light, float32 (n, 3)."""
    if isinstance(light, DirectionalLight):
        return np.broadcast_to(light.towards, normals.shape)
    return _distance_and_direction(light, normals, points)[1]


def _environment(light: EnvironmentLight, normals: NDArray[np.float32], panorama: Lighting | None) -> FloatArray:
    if not light.radiance.any():
        return np.zeros((len(normals), 1), np.float32)
    if panorama is None:
        raise UsageError("the scene has an environment light; give the graph's input `environment` a panorama")
    return _harmonic(rotated(panorama, azimuth=light.azimuth).coefficients, normals)


def _harmonic(coefficients: FloatArray, normals: NDArray[np.float32]) -> FloatArray:
    """max(0, sum_i c_i Y_i(n)): (n, 1) or (n, 3)."""
    order = round(float(np.sqrt(len(coefficients)))) - 1
    received: FloatArray = np.maximum(basis(normals, order) @ coefficients, 0).astype(np.float32)
    return received if received.ndim == 2 else received[:, None]


def _distance_and_direction(
    light: PointLight, normals: NDArray[np.float32], points: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """Distance (n,) and unit vector (n, 3) from each point to the lamp."""
    offset = light.place - (points if points is not None else np.zeros_like(normals))
    distance = np.sqrt(np.einsum("nc,nc->n", offset, offset))
    return distance, offset / np.maximum(distance, np.float32(1e-4))[:, None]


def _wrapped_cosine(cosine: FloatArray, sine: float) -> FloatArray:
    """Lambert's max(0, cos) for a light that the surface's own horizon hides in part near grazing incidence.

    Where |cos| is below `sine`, the sine of the light's angular radius, a parabola joins 0 and the cosine without a
    kink. At grazing incidence it is sine / 4; a uniform disc gives 2 sine / (3 pi), which is nearly the same.
    """
    sine = max(float(sine), 1e-4)
    partly_hidden = np.square(np.maximum(cosine + np.float32(sine), 0)) / np.float32(4 * sine)
    return np.where(cosine < sine, partly_hidden, cosine)


def _inside_cone(light: SpotLight, towards: FloatArray) -> FloatArray:
    """1 within the cone of a spot light, a smooth ramp to 0 over its penumbra: (n,)."""
    off_axis = np.degrees(np.arccos(np.clip(-(towards @ light.axis), -1, 1)))
    return np.asarray(smoothstep((light.cone + light.penumbra - off_axis) / max(light.penumbra, 0.1)), np.float32)
