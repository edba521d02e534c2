"""The face's shading under the lights of a scene."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Lazy, Needs, node
from graphface.nodes.color import encode_srgb, with_channels_of
from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.render.sample_grid import enlarged, on_grid, visible_shares
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Lighting, Mask, Samples, Scene, Shading, Shadows


def needs_of_lights(scene: Scene) -> Needs:
    """Which lazy ports an operator needs that sums up a scene's lights."""
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

    Irradiances are added in linear light. If the photo is sRGB-encoded, the estimated shading is decoded first and the
    sum is encoded afterwards. For a power law encode(albedo * irradiance) = encode(albedo) * encode(irradiance), so an
    encoded albedo goes with an encoded irradiance. (Path-traced heads, true normals, source light left45,
    scale-invariant PSNR: 27.4 dB; with linear values throughout 24.2 dB; with the cosine taken for an encoded value
    20.2 dB.)

    Args:
        samples: the points at which the change of light is computed before it is enlarged; it is as smooth as the
            mesh's normals. The estimated shading, to which it is added, keeps every pixel.
        estimated: the photo's own shading, H x W or H x W x 3, in the photo's encoding: it sets the unit of light.
        shadows: the visible share of each light; without them every light is fully visible.
        panorama: irradiance of the panorama, for environment lights.
        floor: least mean irradiance, in the photo's unit, that `keep_mean` scales up; a darker scene stays darker.

    Returns:
        float32 in the photo's encoding, H x W, or H x W x 3 if the scene or the estimate is colored; 0 where there is
        no surface.
    """
    old, before = samples.irradiance, samples.before
    new = irradiance(scene, samples.normals, samples.points, visible_shares(samples, shadows), panorama)
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
    return _changed(estimated, enlarged(samples, on_grid(samples, encoded - before)), samples.coverage)


def light_gain(scene: Scene, new: FloatArray, old: FloatArray, weights: FloatArray, floor: float = 0.05) -> float:
    """One unit of the scene's light in the photo's linear values, by `scene.keep_mean` and `scene.exposure`.

    Args:
        new, old: irradiance of the scene and of the photo at the samples, (n,) or (n, 3).
        weights: the face mask at the samples, (n,).
        floor: see `shade`.
    """
    gain = scene.exposure * _mean(old, weights)
    if scene.mode != "add" and scene.keep_mean:
        gain /= max(_mean(new, weights), floor)
    return gain


def _mean(irradiances: FloatArray, weights: FloatArray) -> float:
    """Mean over the mask; over all samples where the mask is empty; 0 where there are no samples."""
    if irradiances.size == 0:
        return 0.0
    grey = irradiances if irradiances.shape == weights.shape else irradiances.mean(axis=1, dtype=np.float64)
    total = float(weights.sum(dtype=np.float64))
    if total <= 1e-6:
        return float(grey.mean(dtype=np.float64))
    # Not `@`: on busy cores the threads of a matrix product wait for each other, for milliseconds.
    return float((grey * weights).sum(dtype=np.float64)) / total


def _changed(estimated: Shading, change: FloatArray, coverage: Mask) -> Shading:
    """The estimated shading plus a change of the picture's size; 0 where there is no surface."""
    shading = np.empty(change.shape if change.ndim > estimated.ndim else estimated.shape, np.float32)

    def strip(rows: slice) -> None:
        before, step = (with_channels_of(values[rows], shading) for values in (estimated, change))
        part = np.add(before, step, out=shading[rows])
        np.maximum(part, 0, out=part)
        part *= with_channels_of(coverage[rows], shading)

    by_strips(strip, shading.shape)
    return shading
