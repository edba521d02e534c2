"""Specular highlights of the new lights on the skin."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface import Lazy, node
from graphface.nodes.color import in_three_channels
from graphface.nodes.render.irradiance import directions_to_light, irradiance, unshadowed_irradiance
from graphface.nodes.render.sample_grid import enlarged, on_grid, visible_shares
from graphface.nodes.render.shade import light_gain, needs_of_lights
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
"""F_0, Fresnel reflectance of skin at normal incidence: ((n - 1) / (n + 1))^2 for a refractive index n of 1.4."""


_SKIN_ALBEDO = 0.4
"""Diffuse reflectance of skin that the photo's brightness stands for, so that highlights have its unit."""


_LEAST_COSINE = 0.02
"""Of the angles to light and viewer, which are divided by."""


@node("render.specular", needs=needs_of_lights)
def specular(
    samples: Samples,
    scene: Scene,
    mask: Mask,
    shadows: Lazy[Shadows] = None,
    panorama: Lazy[Lighting] = None,
) -> Shading:
    """What directional, point and spot lights reflect off the skin towards the camera: a GGX microfacet model.

    Walter, Marschner, Li, Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007. Ambient,
    spherical-harmonic and environment light makes no highlights.

    Args:
        scene: `scene.specular` scales the highlights; `scene.roughness` squared is the model's alpha_g.
        mask: the skin, H x W.

    Returns:
        Linear light to be added to the linear picture, H x W x 3, not negative; 0 off the surface.
    """
    normals, points, visible = samples.normals, samples.points, visible_shares(samples, shadows)
    share = scene.mix if scene.mode == "mix" else 1.0
    new = irradiance(scene, normals, points, visible, panorama)
    gain = share * light_gain(scene, new, samples.irradiance, samples.weights)
    total = np.zeros((len(normals), 3), np.float32)
    for index, light in enumerate(scene.lights):
        if isinstance(light, HarmonicLight | EnvironmentLight):
            continue
        reflectance = _ggx(normals, directions_to_light(light, normals, points), scene.roughness)
        received = unshadowed_irradiance(light, normals, points) * visible.get(index, np.float32(1))
        total += (reflectance * received)[:, None] * light.radiance
    scaled = total * np.float32(gain * scene.specular * np.pi / _SKIN_ALBEDO)
    highlights = enlarged(samples, on_grid(samples, scaled))
    result = np.empty_like(highlights)

    def strip(rows: slice) -> None:
        np.multiply(highlights[rows], in_three_channels(mask[rows] * samples.coverage[rows]), out=result[rows])

    by_strips(strip, result.shape)
    return result


def _ggx(normals: NDArray[np.float32], towards: FloatArray, roughness: float) -> FloatArray:
    """f_s = F D G / (4 |i.n| |o.n|) (Walter et al. 2007, equation 20), viewer o at +z, light i `towards`: (n,).

    D is their equation 33 and G the product of their equation 34 for i and o; F is Schlick's approximation (1994).
    """
    half = towards + np.array([0, 0, 1], np.float32)
    half /= np.maximum(np.sqrt(np.einsum("nc,nc->n", half, half)), np.float32(1e-4))[:, None]
    alpha2 = np.float32(roughness**4)  # alpha_g^2
    cos_half = np.clip(np.einsum("nc,nc->n", normals, half), 0, 1)
    cos_light = np.clip(np.einsum("nc,nc->n", normals, towards), _LEAST_COSINE, 1)
    cos_view = np.clip(normals[:, 2], _LEAST_COSINE, 1)
    distribution = alpha2 / (np.float32(np.pi) * np.square(cos_half * cos_half * (alpha2 - 1) + 1))
    fresnel = NORMAL_REFLECTANCE + (1 - NORMAL_REFLECTANCE) * (1 - np.clip(half[:, 2], 0, 1)) ** 5

    def masking(cosine: FloatArray) -> FloatArray:
        visible: FloatArray = 2 * cosine / (cosine + np.sqrt(alpha2 + (1 - alpha2) * cosine * cosine))
        return visible

    reflectance: FloatArray = (
        distribution * fresnel * masking(cos_light) * masking(cos_view) / (4 * cos_light * cos_view)
    )
    return reflectance
