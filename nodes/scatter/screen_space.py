"""Screen-space subsurface scattering with a diffusion profile of skin.

Jimenez, Sundstedt, Gutierrez, Screen-Space Perceptual Rendering of Human Skin, ACM TAP 2009: the diffusion profile of
skin is a sum of Gaussians per channel, which blur the rendered irradiance in the picture, but not across steps in
depth. The profile is that of a three-layer skin model (d'Eon, Luebke, Enderton, Efficient Rendering of Human Skin, EGSR
2007). Red light travels furthest, so shadow edges turn warm.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import in_three_channels
from graphface.nodes.scatter.smoothed_change import smoothed_change
from graphface.nodes.types import FloatArray, Image, Landmarks, Scene, Shading, Surface

PROFILE = (
    # Variance in mm^2; weights of red, green, blue.
    (0.0064, (0.233, 0.455, 0.649)),
    (0.0484, (0.100, 0.336, 0.344)),
    (0.187, (0.118, 0.198, 0.0)),
    (0.567, (0.113, 0.007, 0.007)),
    (1.99, (0.358, 0.004, 0.0)),
    (7.41, (0.078, 0.0, 0.0)),
)


WIDEST = float(np.sqrt(PROFILE[-1][0]))
"""Standard deviation of the widest Gaussian, mm, which `scene.scatter` sets. On a real face it is about 0.03
inter-ocular distances."""


_LEAST_SIGMA = 0.35
"""Grid points; a narrower Gaussian changes nothing."""


_EXTENT = 2.5
"""Half width of the kernel in standard deviations."""


@node("scatter.screen_space")
def screen_space(
    shading: Shading,
    estimated: Shading,
    surface: Surface,
    landmarks: Landmarks,
    photo: Image,
    scene: Scene,
    *,
    depth_falloff: Annotated[float, Field(ge=0, le=1000)] = 8.0,
) -> Shading:
    """The change of light, smoothed by a skin profile whose widest Gaussian is `scene.scatter`.

    Args:
        shading, estimated: under the new and the photo's own light, H x W or H x W x 3, in the photo's encoding.
        surface: light passes neither its silhouette nor a step in its depth.
        depth_falloff: the weight across a step in depth falls from 1 to 0 over 1 / depth_falloff inter-ocular
            distances.

    Returns:
        float32 H x W x 3.
    """
    to_weight = np.float32(depth_falloff / max(landmarks.interocular, 1e-3))

    def smooth(change: FloatArray, coverage: FloatArray, depth: FloatArray, resolution: float) -> FloatArray:
        change = np.ascontiguousarray(np.broadcast_to(change, (*change.shape[:2], 3)))
        total, depth = np.zeros_like(change), depth * to_weight
        blurred, before = change, 0.0
        for variance, weights in PROFILE:
            # Each Gaussian is a further blur of the one before: variances add up.
            sigma = float(np.sqrt(variance)) / WIDEST * scene.scatter * resolution
            if sigma > _LEAST_SIGMA:
                further = float(np.sqrt(sigma * sigma - before * before))
                blurred, before = _blurred_on_surface(blurred, coverage, depth, further), sigma
            total += blurred * np.asarray(weights, np.float32)
        return np.asarray(total / np.sum([weights for _, weights in PROFILE], axis=0), np.float32)

    return smoothed_change(shading, estimated, surface, landmarks, photo, smooth)


def _blurred_on_surface(change: FloatArray, coverage: FloatArray, depth: FloatArray, sigma: float) -> FloatArray:
    """A Gaussian along rows, then along columns; beyond the border the outermost point repeats.

    Args:
        change: h x w x 3.
        depth: h x w, in the unit over which the weight of a point falls to 0.
        sigma: in points.
    """
    reach = 0
    if min(coverage.shape) > 1:
        reach = min(max(1, round(_EXTENT * sigma)), *(length - 1 for length in coverage.shape))
    for axis in (1, 0):
        change = _blurred_along(axis, change, coverage, depth, sigma, reach)
    return change


def _blurred_along(
    axis: int, change: FloatArray, coverage: FloatArray, depth: FloatArray, sigma: float, reach: int
) -> FloatArray:
    """Along one axis. The share of a tap that is off the surface or across a step in depth goes to the middle tap."""
    margin = [(reach, reach) if n == axis else (0, 0) for n in range(2)]
    padded_coverage, padded_depth = (np.pad(map_, margin, mode="edge") for map_ in (coverage, depth))
    padded_change = np.pad(change, [*margin, (0, 0)], mode="edge")
    moved, total = np.zeros_like(change), 1.0
    for step in range(1, reach + 1):
        weight = np.float32(np.exp(-step * step / (2 * sigma * sigma)))
        for start in (reach - step, reach + step):
            tap = (slice(None),) * axis + (slice(start, start + coverage.shape[axis]),)
            share = np.abs(padded_depth[tap] - depth)
            np.maximum(1 - share, 0, out=share)
            share *= padded_coverage[tap]
            share *= weight
            moved += in_three_channels(share) * (padded_change[tap] - change)
            total += float(weight)
    return change + moved / np.float32(total)
