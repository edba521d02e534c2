"""Highlights that the new lights make on the skin; off unless a scene asks for them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface import Lazy, node
from graphface.nodes.color import in_three_channels
from graphface.nodes.render.irradiance import arriving, irradiance, towards_light
from graphface.nodes.render.shade import light_gain, needs_of_lights, seen_shares
from graphface.nodes.strips import by_strips
from graphface.nodes.types import (
    EnvironmentLight,
    FloatArray,
    HarmonicLight,
    Lighting,
    Mask,
    Samples,
    Scene,
    Shading,
    Shadows,
)

NORMAL_REFLECTANCE = 0.028
"""Fresnel reflectance of skin head-on (index of refraction 1.4)."""


_SKIN_ALBEDO = 0.4
"""Diffuse reflectance that the photo's brightness is taken to stand for, where highlights are compared with it."""


@node("render.specular", needs=needs_of_lights)
def specular(
    samples: Samples,
    scene: Scene,
    mask: Mask,
    shadows: Lazy[Shadows] = None,
    panorama: Lazy[Lighting] = None,
) -> Shading:
    """What directional, point and spot lights reflect off the skin towards the camera: microfacets after GGX.

    Walter, Marschner, Li, Torrance, Microfacet Models for Refraction, EGSR 2007; `scene.roughness` squared is their
    alpha. Ambient and spherical-harmonic light makes none.

    Args:
        mask: where there is skin, H x W.

    Returns:
        Linear light to be added to the linear picture, H x W x 3, not negative; 0 off the surface.
    """
    normals, points, visible = samples.normals, samples.points, seen_shares(samples, shadows)
    share = scene.mix if scene.mode == "mix" else 1.0
    new = irradiance(scene, normals, points, visible, panorama)
    gain = share * light_gain(scene, new, samples.irradiance, samples.weights)
    total = np.zeros((len(normals), 3), np.float32)
    for index, light in enumerate(scene.lights):
        if isinstance(light, HarmonicLight | EnvironmentLight):
            continue
        lobe = _lobe(normals, towards_light(light, normals, points), scene.roughness)
        arrives = arriving(light, normals, points) * visible.get(index, np.float32(1))
        total += (lobe * arrives)[:, None] * light.radiance
    shine = samples.enlarged(samples.on_grid(total * np.float32(gain * scene.specular * np.pi / _SKIN_ALBEDO)))
    result = np.empty_like(shine)

    def strip(rows: slice) -> None:
        np.multiply(shine[rows], in_three_channels(mask[rows] * samples.coverage[rows]), out=result[rows])

    by_strips(strip, result.shape)
    return result


def _lobe(normals: NDArray[np.float32], towards: FloatArray, roughness: float) -> FloatArray:
    """D F G / (4 (n.l) (n.v)) with the viewer at +z: (n,)."""
    half = towards + np.array([0, 0, 1], np.float32)
    half /= np.maximum(np.sqrt(np.einsum("nc,nc->n", half, half)), np.float32(1e-4))[:, None]
    alpha2 = np.float32(roughness**4)
    n_h = np.clip(np.einsum("nc,nc->n", normals, half), 0, 1)
    n_l = np.clip(np.einsum("nc,nc->n", normals, towards), 0.02, 1)
    n_v = np.clip(normals[:, 2], 0.02, 1)
    distribution = alpha2 / (np.float32(np.pi) * np.square(n_h * n_h * (alpha2 - 1) + 1))
    fresnel = NORMAL_REFLECTANCE + (1 - NORMAL_REFLECTANCE) * (1 - np.clip(half[:, 2], 0, 1)) ** 5

    def smith(cosine: FloatArray) -> FloatArray:
        shadowed: FloatArray = 2 * cosine / (cosine + np.sqrt(alpha2 + (1 - alpha2) * cosine * cosine))
        return shadowed

    lobe: FloatArray = distribution * fresnel * smith(n_l) * smith(n_v) / (4 * n_l * n_v)
    return lobe
