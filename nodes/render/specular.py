"""Highlights that the new lights make on the skin; off unless a scene asks for them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface import Lazy, Needs, node
from graphface.nodes.colour import decode_srgb
from graphface.nodes.render.irradiance import arriving, irradiance, towards_light
from graphface.nodes.render.lights import EnvironmentLight, HarmonicLight
from graphface.nodes.render.places import surface_points
from graphface.nodes.render.scene import Scene
from graphface.nodes.render.shade import light_gain
from graphface.nodes.render.visibility import Shadows
from graphface.nodes.sh import has_surface
from graphface.nodes.types import FloatArray, Image, Lighting, Mask, Mesh, Normals, Shading, Surface

NORMAL_REFLECTANCE = 0.028
"""Fresnel reflectance of skin head-on (index of refraction 1.4)."""

_SKIN_ALBEDO = 0.4
"""Diffuse reflectance that the photo's brightness is taken to stand for, where highlights are compared with it."""


def _wanted(scene: Scene) -> Needs:
    return {
        "shadows": bool(scene.casting) or "no light of the scene casts a shadow that the camera could see",
        "panorama": scene.surrounded or "the scene has no environment light",
    }


@node("render.specular", needs=_wanted)
def specular(
    normals: Normals,
    scene: Scene,
    estimated: Shading,
    mask: Mask,
    photo: Image,
    mesh: Mesh,
    surface: Surface,
    shadows: Lazy[Shadows] = None,
    panorama: Lazy[Lighting] = None,
) -> Shading:
    """What directional, point and spot lights reflect off the skin towards the camera: microfacets after GGX.

    Walter, Marschner, Li, Torrance, Microfacet Models for Refraction, EGSR 2007; `scene.roughness` squared is their
    alpha. Ambient and spherical-harmonic light makes none.

    Returns:
        Linear light to be added to the linear picture, H x W x 3, not negative; 0 off the surface.
    """
    covered = has_surface(normals)
    facing = normals[covered]
    points = surface_points(covered, surface, mesh)
    visible = {} if shadows is None else {n: shadows.of(n, mask.shape)[covered] for n in shadows.lights}
    old = estimated[covered].astype(np.float32, copy=False)
    old = np.maximum(decode_srgb(old) if photo.encoding == "srgb" else old, 0)
    share = scene.mix if scene.mode == "mix" else 1.0
    gain = share * light_gain(scene, irradiance(scene, facing, points, visible, panorama), old, mask[covered])
    total = np.zeros((len(facing), 3), np.float32)
    for index, light in enumerate(scene.lights):
        if isinstance(light, HarmonicLight | EnvironmentLight):
            continue
        lobe = _lobe(facing, towards_light(light, facing, points), scene.roughness)
        arrives = arriving(light, facing, points) * visible.get(index, np.float32(1))
        total += (lobe * arrives)[:, None] * light.radiance
    result = np.zeros((*covered.shape, 3), np.float32)
    result[covered] = total * np.float32(gain * scene.specular * np.pi / _SKIN_ALBEDO)
    return result * mask[..., None]


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
