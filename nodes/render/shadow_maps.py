"""Shadows of the face on itself, for every light of a scene that casts one."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.render.depth_buffer import disc, visible_share
from graphface.nodes.types import DirectionalLight, FloatArray, Mesh, Samples, Scene, Shadows
from graphface.nodes.types.lights import Casting

_DIRECTIONAL_DISTANCE = 40.0
"""Distance at which a directional light is placed, inter-ocular distances. Across the face its rays then differ by one
or two degrees."""


_LARGEST_RADIUS = np.radians(45.0)
"""Angular radius of a light beyond which its shadow gets no softer, because nothing of it is visible any more."""


@node("render.shadow_maps")
def shadow_maps(
    mesh: Mesh,
    receivers: Samples,
    scene: Scene,
    *,
    resolution: Annotated[int, Field(ge=1, le=4096)] = 256,
    samples: Annotated[int, Field(ge=1, le=256)] = 12,
    bias: Annotated[float, Field(ge=0, le=0.5), Formerly("lift")] = 0.02,
    smoothing: Annotated[float, Field(ge=0, le=0.5)] = 0.02,
) -> Shadows:
    """The visible share of each shadow-casting light at the points that the camera sees.

    Args:
        mesh: casts the shadows.
        receivers: points of the same mesh; the result has their grid.
        resolution: texels along a side of each light's depth buffer.
        samples: points on a `soft` light. A `hard` one has a single point and twice the resolution.
        bias: height above the surface from which a point is compared with the depth buffer, inter-ocular distances.
        smoothing: standard deviation of the blur of the result, inter-ocular distances.

    Returns:
        One map for each casting light.
    """
    unit = max(mesh.interocular, 1e-3)
    vertices = np.ascontiguousarray(mesh.vertices / np.float32(unit), np.float32)
    maps = {}
    for index, light in scene.casting.items():
        shares = np.ones(len(receivers.points), np.float32)
        if shares.size and np.isfinite(vertices).all():
            soft = light.shadow == "soft" and samples > 1 and light.size > 0
            shares = visible_share(
                receivers.points,
                receivers.normals,
                _points_on_light(light, samples if soft else 1),
                vertices,
                mesh.triangles,
                resolution=resolution if soft else 2 * resolution,
                bias=bias,
            )
        maps[index] = _smoothed(shares, receivers, smoothing * receivers.grid[1] / receivers.picture[1] * unit)
    stacked = np.stack(list(maps.values())) if maps else np.ones((0, *receivers.grid), np.float32)
    return Shadows(lights=tuple(maps), visible=stacked)


def _points_on_light(light: Casting, count: int) -> FloatArray:
    """Points on the light's disc, float32 (count, 3), inter-ocular distances from the middle of the face."""
    middle = light.towards * np.float32(_DIRECTIONAL_DISTANCE) if isinstance(light, DirectionalLight) else light.place
    distance = max(float(np.linalg.norm(middle)), 1e-6)
    radius = distance * float(np.tan(min(np.radians(light.size), _LARGEST_RADIUS)))
    return np.asarray(middle + disc(middle / distance, radius, count), np.float32)


def _smoothed(shares: FloatArray, receivers: Samples, sigma: float) -> FloatArray:
    """The shares (n,) on the grid, blurred within the surface and continued a little beyond it; 1 elsewhere."""
    import cv2

    sigma = max(sigma, 0.6)
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
