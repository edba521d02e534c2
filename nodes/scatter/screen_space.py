"""Screen-space subsurface scattering with a skin profile.

Jimenez, Sundstedt, Gutierrez, Screen-Space Perceptual Rendering of Human Skin, ACM TAP 2009: the diffusion profile of
skin as a sum of Gaussians per channel (d'Eon, Luebke, Enderton 2007, table of a three-layer skin model), applied to the
rendered irradiance in the picture, across at most the surface at hand. Red travels furthest: shadow edges turn warm.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import in_three_channels
from graphface.nodes.scatter.change import smoothed_change
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
"""Standard deviation of the widest Gaussian, mm: what `scene.scatter` sets. On a face it is 0.03 eye distances."""


_NARROWEST = 0.35
"""Standard deviation in points below which a Gaussian is as good as none."""


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
    """The change of light, spread by a skin profile whose widest Gaussian is `scene.scatter`, three channels.

    Args:
        shading, estimated: under the new and the photo's own light, H x W or H x W x 3, in the photo's encoding.
        surface: light passes neither its silhouette nor a step in its depth.
        depth_falloff: how fast a step in depth stops light; 1 over inter-ocular distances.

    Returns:
        float32 H x W x 3.
    """

    def blur(change: FloatArray, inside: FloatArray, depth: FloatArray, unit: float) -> FloatArray:
        depth = depth * np.float32(depth_falloff / max(landmarks.interocular, 1e-3))
        change = np.ascontiguousarray(np.broadcast_to(change, (*change.shape[:2], 3)))
        spread = np.zeros_like(change)
        reached, before = change, 0.0
        for variance, weights in PROFILE:
            # Each Gaussian is reached from the one before it: variances add up.
            sigma = float(np.sqrt(variance)) / WIDEST * scene.scatter * unit
            if sigma > _NARROWEST:
                reached = _along(reached, inside, depth, float(np.sqrt(sigma * sigma - before * before)))
                before = sigma
            spread += reached * np.asarray(weights, np.float32)
        return np.asarray(spread / np.sum([w for _, w in PROFILE], axis=0), np.float32)

    return smoothed_change(shading, estimated, surface, landmarks, photo, blur)


def _along(change: FloatArray, inside: FloatArray, depth: FloatArray, sigma: float) -> FloatArray:
    """A Gaussian along rows, then along columns; a tap across a step in depth counts as the middle instead."""
    reach = min(max(1, round(2.5 * sigma)), *(max(n - 1, 0) for n in inside.shape)) if min(inside.shape) > 1 else 0
    for axis in (1, 0):
        # The border repeats.
        margin = [(reach, reach) if n == axis else (0, 0) for n in range(2)]
        wide_inside, wide_depth = (np.pad(map_, margin, mode="edge") for map_ in (inside, depth))
        wide_change = np.pad(change, [*margin, (0, 0)], mode="edge")
        moved, sums = np.zeros_like(change), 1.0
        for step in range(1, reach + 1):
            weight = np.float32(np.exp(-step * step / (2 * sigma * sigma)))
            for start in (reach - step, reach + step):
                tap = tuple(slice(start, start + inside.shape[n]) if n == axis else slice(None) for n in range(2))
                kept = np.abs(wide_depth[tap] - depth)
                np.maximum(1 - kept, 0, out=kept)
                kept *= wide_inside[tap]
                kept *= weight
                moved += in_three_channels(kept) * (wide_change[tap] - change)
                sums += float(weight)
        change = change + moved / np.float32(sums)
    return change
