"""New shading of the face under a scene's lights."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import Lazy, Needs, node
from graphface.nodes.colour import decode_srgb, encode_srgb
from graphface.nodes.detail.rendering import in_three_channels
from graphface.nodes.render.irradiance import irradiance
from graphface.nodes.render.places import grid_middles, lifted_pixels
from graphface.nodes.render.scene import Scene
from graphface.nodes.render.visibility import Shadows
from graphface.nodes.sh import has_surface
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Image, Lighting, Mask, Mesh, Normals, Shading, Surface


def _wanted(scene: Scene) -> Needs:
    return {
        "shadows": bool(scene.casting) or "no light of the scene casts a shadow that the camera could see",
        "panorama": scene.surrounded or "the scene has no environment light",
        "surface": scene.local or "no light of the scene is near, so places on the face do not matter",
    }


@node("render.shade", needs=_wanted)
def shade(
    normals: Normals,
    scene: Scene,
    estimated: Shading,
    mask: Mask,
    photo: Image,
    mesh: Mesh | None = None,
    surface: Lazy[Surface] = None,
    shadows: Lazy[Shadows] = None,
    panorama: Lazy[Lighting] = None,
    *,
    detail: Annotated[float, Field(ge=8, le=4096)] = 96,
    floor: Annotated[float, Field(gt=0, le=1)] = 0.05,
) -> Shading:
    """The face's shading under a scene: spherical harmonics, and Lambert's cosine for the other lights.

    Light adds up linearly. Where the photo's values are sRGB-encoded the estimated shading is decoded, the sum formed,
    and the result encoded: for a power law encode(albedo * irradiance) = encode(albedo) * encode(irradiance), so
    encoded albedo goes with encoded irradiance. (Path-traced heads, true normals, left45, scale-invariant PSNR: 27.4 dB
    this way, 24.2 with linear values throughout, 20.2 with Lambert's cosine taken for encoded values.)

    Args:
        normals: H x W x 3; pixels without surface get 0.
        estimated: the photo's own shading at the same pixels, H x W, in the photo's encoding: it sets the unit of
            light.
        mask: the face, over which brightness is compared.
        photo: gives the encoding.
        mesh: tells the size of the face; without it every pixel is shaded.
        surface: where the pixels lie, for lights that stand near; without it all lie at the face's middle.
        panorama: irradiance of the surroundings, for environment lights.
        shadows: what of each light arrives; without them everything does.
        detail: points shaded per inter-ocular distance. The change of light is as smooth as the mesh's normals, so it
            is found on a grid and enlarged; the estimated shading, to which it is added, keeps every pixel.
        floor: least mean irradiance, in the photo's unit, that `keep_mean` scales up; a darker scene stays darker.

    Returns:
        float32 in the photo's encoding, H x W, or H x W x 3 where the scene (or the estimate) is coloured.
    """
    scale = detail / max(float(mesh.interocular), 1e-3) if mesh is not None else 1.0
    height, width = normals.shape[:2]
    v, u = grid_middles(height, scale), grid_middles(width, scale)
    places = v[:, None] * width + u  # of the grid's points in the flat picture
    facing = normals.reshape(-1, 3).take(places, axis=0)
    covered = has_surface(facing)
    facing, places = facing[covered], places[covered]
    encoded = photo.encoding == "srgb"
    before = estimated.reshape(height * width, *estimated.shape[2:]).take(places, axis=0).astype(np.float32, copy=False)
    old = np.maximum(decode_srgb(before) if encoded else before, 0)
    points = None if mesh is None or surface is None or not scene.local else _points(places, surface, mesh)
    visible = {} if shadows is None else {n: shadows.of(n, covered.shape)[covered] for n in shadows.lights}
    new = irradiance(scene, facing, points, visible, panorama)
    if new.ndim < old.ndim:
        new = new[:, None]
    elif old.ndim < new.ndim:
        old, before = old[:, None], before[:, None]

    gain = light_gain(scene, new, old, mask.reshape(-1).take(places), floor)
    if scene.mode == "add":
        linear = old + gain * new
    else:
        share = scene.mix if scene.mode == "mix" else 1.0
        linear = old + share * (gain * new - old)
    change = np.zeros((*covered.shape, *linear.shape[1:]), np.float32)
    change[covered] = (encode_srgb(linear.astype(np.float32)) if encoded else linear) - before
    return _changed(estimated, change, normals)


def _points(places: NDArray[np.intp], surface: Surface, mesh: Mesh) -> FloatArray:
    """Where points of the flat picture lie in space, inter-ocular distances: (n, 3)."""
    v, u = np.divmod(places, surface.depth.shape[1])
    points = lifted_pixels(u, v, surface.depth.reshape(-1).take(places), mesh.camera)
    return points / np.float32(max(mesh.interocular, 1e-3))


def _changed(estimated: Shading, change: FloatArray, normals: Normals) -> Shading:
    """The estimated shading plus a change known on a grid; 0 where there is no surface."""
    import cv2

    height, width = estimated.shape[:2]
    if change.shape[:2] != (height, width):
        change = np.asarray(cv2.resize(change, (width, height), interpolation=cv2.INTER_LINEAR), np.float32)
    shading = np.empty(change.shape if change.ndim > estimated.ndim else estimated.shape, np.float32)

    def strip(rows: slice) -> None:
        covered = (normals[rows, :, 2] != 0).astype(np.float32)  # what the camera sees is never quite sideways
        part = _like(estimated[rows], shading) + _like(change[rows], shading)
        np.maximum(part, 0, out=part)
        np.multiply(part, _like(covered, shading), out=shading[rows])

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
