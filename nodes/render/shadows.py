"""Shadows that the face casts on itself, for every light of a scene that casts one."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.render.lights import Casting, DirectionalLight
from graphface.nodes.render.places import points_seen
from graphface.nodes.render.scene import Scene
from graphface.nodes.render.shadow_map import disc, lit_share
from graphface.nodes.render.visibility import Shadows
from graphface.nodes.types import FloatArray, Mesh, Surface

_SUN = 40.0
"""Where a directional light is put, inter-ocular distances: its rays then part by a degree or two across the face."""

_LARGEST = np.radians(45.0)
"""Angle to the edge beyond which a light's shadow gets no softer: nothing of it is left to see."""


@node("render.shadow_maps")
def shadow_maps(
    mesh: Mesh,
    surface: Surface,
    scene: Scene,
    *,
    resolution: Annotated[int, Field(ge=1, le=4096)] = 320,
    samples: Annotated[int, Field(ge=1, le=256)] = 12,
    detail: Annotated[int, Field(ge=4, le=1024)] = 64,
    lift: Annotated[float, Field(ge=0, le=0.5)] = 0.02,
    smoothing: Annotated[float, Field(ge=0, le=0.5)] = 0.02,
) -> Shadows:
    """How much of each casting light reaches the face past the face itself.

    Args:
        mesh: casts the shadows.
        surface: the same mesh as the camera sees it; receives them.
        resolution: texels along a side of each light's depth buffer.
        samples: places on a `soft` light; a `hard` one has one, with twice the resolution.
        detail: receiving points per inter-ocular distance.
        lift: see `graphface.nodes.render.shadow_map`, inter-ocular distances.
        smoothing: blur of the result, inter-ocular distances.

    Returns:
        One map per casting light, at `detail` points per inter-ocular distance (or the photo's own, if that is less).
    """
    unit = max(mesh.interocular, 1e-3)
    points, normals, covered = points_seen(mesh, surface, min(1.0, detail / unit))
    vertices = np.ascontiguousarray(mesh.vertices / np.float32(unit), np.float32)
    maps = {}
    for index, light in scene.casting.items():
        visible = np.ones(covered.shape, np.float32)
        if covered.any() and np.isfinite(vertices).all():
            soft = light.shadow == "soft" and samples > 1 and light.size > 0
            visible[covered] = lit_share(
                points,
                normals,
                _places(light, samples if soft else 1),
                vertices,
                mesh.triangles,
                resolution=resolution if soft else 2 * resolution,
                lift=lift,
            )
            visible = _smoothed(visible, covered, smoothing * covered.shape[1] / surface.coverage.shape[1] * unit)
        maps[index] = visible
    shape = (0, *covered.shape)
    stacked = np.stack(list(maps.values())) if maps else np.ones(shape, np.float32)
    return Shadows(lights=tuple(maps), visible=stacked)


def _places(light: Casting, count: int) -> FloatArray:
    """Points on the light, (count, 3), inter-ocular distances."""
    middle = light.towards * np.float32(_SUN) if isinstance(light, DirectionalLight) else light.place
    distance = max(float(np.linalg.norm(middle)), 1e-6)
    radius = distance * float(np.tan(min(np.radians(light.size), _LARGEST)))
    return np.asarray(middle + disc(middle / distance, radius, count), np.float32)


def _smoothed(visible: FloatArray, covered: np.ndarray[tuple[int, ...], np.dtype[np.bool_]], blur: float) -> FloatArray:
    """Blurred within the surface, and continued a little beyond it, so that enlarging the map mixes nothing foreign."""
    import cv2

    sigma = max(blur, 0.6)
    weight = covered.astype(np.float32)
    sums, weights = (
        np.asarray(cv2.GaussianBlur(v, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE), np.float32)
        for v in (visible * weight, weight)
    )
    return np.where(weights > 1e-3, sums / np.maximum(weights, np.float32(1e-3)), 1).clip(0, 1).astype(np.float32)
