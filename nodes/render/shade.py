"""New shading of the face under a scene's lights."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Lazy, Needs, node
from graphface.nodes.color import encode_srgb, in_three_channels
from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Lighting, Mask, Samples, Scene, Shading, Shadows


def needs_of_lights(scene: Scene) -> Needs:
    """What a node that adds up a scene's lights needs of its lazy ports."""
    return {
        "shadows": bool(scene.casting) or "no light of the scene casts a shadow that the camera could see",
        "panorama": scene.surrounded or "the scene has no environment light",
    }


@node("render.shade", needs=needs_of_lights)
def shade(
    samples: Samples,
    scene: Scene,
    estimated: Shading,
    shadows: Lazy[Shadows] = None,
    panorama: Lazy[Lighting] = None,
    *,
    floor: Annotated[float, Field(gt=0, le=1)] = 0.05,
) -> Shading:
    """The face's shading under a scene: spherical harmonics, and Lambert's cosine for the other lights.

    Light adds up linearly. Where the photo's values are sRGB-encoded the estimated shading is decoded, the sum formed,
    and the result encoded: for a power law encode(albedo * irradiance) = encode(albedo) * encode(irradiance), so
    encoded albedo goes with encoded irradiance. (Path-traced heads, true normals, left45, scale-invariant PSNR: 27.4 dB
    this way, 24.2 with linear values throughout, 20.2 with Lambert's cosine taken for encoded values.)

    Args:
        samples: the points that are shaded. The change of light is as smooth as the mesh's normals, so it is found
            there and enlarged; the estimated shading, to which it is added, keeps every pixel.
        estimated: the photo's own shading, H x W or H x W x 3, in the photo's encoding: it sets the unit of light.
        shadows: what of each light arrives; without them everything does.
        panorama: irradiance of the surroundings, for environment lights.
        floor: least mean irradiance, in the photo's unit, that `keep_mean` scales up; a darker scene stays darker.

    Returns:
        float32 in the photo's encoding, H x W, or H x W x 3 where the scene (or the estimate) is colored; 0 where
        there is no surface.
    """
    old, before = samples.irradiance, samples.before
    new = irradiance(scene, samples.normals, samples.points, seen_shares(samples, shadows), panorama)
    if new.ndim < old.ndim:
        new = new[:, None]
    elif old.ndim < new.ndim:
        old, before = old[:, None], before[:, None]

    gain = light_gain(scene, new, old, samples.weights, floor)
    if scene.mode == "add":
        linear = old + gain * new
    else:
        share = scene.mix if scene.mode == "mix" else 1.0
        linear = old + share * (gain * new - old)
    encoded = encode_srgb(linear) if samples.encoding == "srgb" else linear
    return _changed(estimated, samples.enlarged(samples.on_grid(encoded - before)), samples.coverage)


def seen_shares(samples: Samples, shadows: Shadows | None) -> dict[int, FloatArray]:
    """The share (n,) of each casting light that arrives at the points."""
    if shadows is None:
        return {}
    return {light: samples.at_points(shadows.of(light, samples.grid)) for light in shadows.lights}


def _changed(estimated: Shading, change: FloatArray, coverage: Mask) -> Shading:
    """The estimated shading plus a change of the picture's size; 0 where there is no surface."""
    shading = np.empty(change.shape if change.ndim > estimated.ndim else estimated.shape, np.float32)

    def strip(rows: slice) -> None:
        part = np.add(_like(estimated[rows], shading), _like(change[rows], shading), out=shading[rows])
        np.maximum(part, 0, out=part)
        part *= _like(coverage[rows], shading)

    by_strips(strip, shading.shape)
    return shading


def _like(values: FloatArray, shading: Shading) -> FloatArray:
    """A grey map in three channels where the shading has them."""
    return in_three_channels(values) if values.ndim < shading.ndim else values


def light_gain(scene: Scene, new: FloatArray, old: FloatArray, weights: FloatArray, floor: float = 0.05) -> float:
    """What one unit of a scene's light is in the photo's linear values, so that the face is as bright as wished."""
    gain = scene.exposure * _mean(old, weights)
    if scene.mode != "add" and scene.keep_mean:
        gain /= max(_mean(new, weights), floor)
    return gain


def _mean(irradiances: FloatArray, weights: FloatArray) -> float:
    """Mean over the mask; over all pixels where the mask is empty; 0 where there are none."""
    if irradiances.size == 0:
        return 0.0
    grey = irradiances if irradiances.shape == weights.shape else irradiances.mean(axis=1, dtype=np.float64)
    total = float(weights.sum(dtype=np.float64))
    if total <= 1e-6:
        return float(grey.mean(dtype=np.float64))
    # Not `@`: on busy cores the threads of a matrix product wait for each other, for milliseconds.
    return float((grey * weights).sum(dtype=np.float64)) / total
