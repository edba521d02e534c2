"""Shadows that the face casts on itself, for every light of a scene that casts one."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.render.shadow_map import disc, lit_share
from graphface.nodes.types import DirectionalLight, FloatArray, Mesh, Samples, Scene, Shadows
from graphface.nodes.types.lights import Casting

_SUN = 40.0
"""Where a directional light is put, inter-ocular distances: its rays then part by a degree or two across the face."""


_LARGEST = np.radians(45.0)
"""Angle to the edge beyond which a light's shadow gets no softer: nothing of it is left to see."""


@node("render.shadow_maps")
def shadow_maps(
    mesh: Mesh,
    receivers: Samples,
    scene: Scene,
    *,
    resolution: Annotated[int, Field(ge=1, le=4096)] = 256,
    samples: Annotated[int, Field(ge=1, le=256)] = 12,
    lift: Annotated[float, Field(ge=0, le=0.5)] = 0.02,
    smoothing: Annotated[float, Field(ge=0, le=0.5)] = 0.02,
) -> Shadows:
    """How much of each casting light reaches the face past the face itself.

    Args:
        mesh: casts the shadows.
        receivers: points of the same mesh that the camera sees; the answer is as fine as their grid.
        resolution: texels along a side of each light's depth buffer.
        samples: places on a `soft` light; a `hard` one has one, with twice the resolution.
        lift: see `graphface.nodes.render.shadow_map`, inter-ocular distances.
        smoothing: blur of the result, inter-ocular distances.

    Returns:
        One map per casting light, of the receivers' grid.
    """
    unit = max(mesh.interocular, 1e-3)
    vertices = np.ascontiguousarray(mesh.vertices / np.float32(unit), np.float32)
    maps = {}
    for index, light in scene.casting.items():
        shares = np.ones(len(receivers.points), np.float32)
        if shares.size and np.isfinite(vertices).all():
            soft = light.shadow == "soft" and samples > 1 and light.size > 0
            shares = lit_share(
                receivers.points,
                receivers.normals,
                _places(light, samples if soft else 1),
                vertices,
                mesh.triangles,
                resolution=resolution if soft else 2 * resolution,
                lift=lift,
            )
        maps[index] = _smoothed(shares, receivers, smoothing * receivers.grid[1] / receivers.picture[1] * unit)
    stacked = np.stack(list(maps.values())) if maps else np.ones((0, *receivers.grid), np.float32)
    return Shadows(lights=tuple(maps), visible=stacked)


def _places(light: Casting, count: int) -> FloatArray:
    """Points on the light, (count, 3), inter-ocular distances."""
    middle = light.towards * np.float32(_SUN) if isinstance(light, DirectionalLight) else light.place
    distance = max(float(np.linalg.norm(middle)), 1e-6)
    radius = distance * float(np.tan(min(np.radians(light.size), _LARGEST)))
    return np.asarray(middle + disc(middle / distance, radius, count), np.float32)


def _smoothed(shares: FloatArray, receivers: Samples, blur: float) -> FloatArray:
    """On the grid, blurred within the surface, and continued a little beyond it; 1 elsewhere."""
    import cv2

    sigma = max(blur, 0.6)
    weight, visible = (np.zeros(receivers.grid, np.float32) for _ in range(2))
    weight.reshape(-1)[receivers.cells] = 1
    visible.reshape(-1)[receivers.cells] = shares
    sums, weights = (
        np.asarray(cv2.GaussianBlur(v, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE), np.float32)
        for v in (visible, weight)
    )
    sums /= np.maximum(weights, np.float32(1e-3))
    sums[weights <= 1e-3] = 1
    return np.clip(sums, 0, 1, out=sums)
