"""What lies behind a head is as far from the lamps as it is, not as its rim."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean, with_channels_of
from graphface.nodes.pixel_grid import grid_middles, lifted_pixels
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Image, Mesh, PointLight, Scene, Shading

_CELLS = 48
"""Along the longer side of the picture, at which the falloff is computed; it is smooth."""

_MOST = 4.0
"""Factor of a wall that a lamp stands close to."""

_ENCODED = 1 / 2.2
"""Exponent of a factor of light for values in the sRGB encoding."""

_SHOULDERS = (-1.5, 1.4, 0.9)
"""Height of the shoulders from the middle of the face, half their width there, and what it grows by farther down."""

_SOFT = 0.7
"""Over which the body passes into the wall. All in inter-ocular distances."""

_OTHERS = 0.5
"""Share of a light without a place that a wall gets on average."""


@node("render.wall")
def wall(
    estimated: Shading,
    relit: Shading,
    scene: Scene,
    mesh: Mesh,
    photo: Image,
    *,
    distance: Annotated[float, Field(ge=0, le=100)] = 3.0,
) -> Shading:
    """The new shading of a wall behind the head, and of a body below it, on which the light of near lamps falls off.

    Shading beyond the head continues that of its rim. A candle before a face lights what is behind it by a fraction,
    and more on its own side. So the new light counts in proportion to

        (a + sum_i I_i r_i(x)) / (a + sum_i I_i)

    over the lamps that have a place, with r_i(x) the reach of lamp i at the wall relative to that at the face, and a,
    the light that has no place. A body, where a portrait has one, is as far away as the head.

    Args:
        estimated, relit: shading of the whole picture under the photo's own and the new light; H x W or H x W x 3.
        mesh: gives the place and the size of the head, and the camera.
        photo: its encoding is that of the shading.
        distance: of the wall behind the middle of the head, in inter-ocular distances.

    Returns:
        float32 of the shape of `relit`, or three channels where the lamps are colored; `relit` itself in a scene in
        which no lamp has a place.
    """
    if not placed_lamps(scene) or relit.size == 0:
        return relit
    reach = _falloff(scene, mesh, relit.shape[:2], distance)
    if photo.encoding == "srgb":
        reach = reach ** np.float32(_ENCODED)
    kept = {"replace": 0.0, "mix": 1 - scene.mix, "add": 1.0}[scene.mode]
    found = np.empty(relit.shape if relit.ndim == 3 else reach.shape, np.float32)

    def strip(rows: slice) -> None:
        new = with_channels_of(relit[rows], found)
        old = with_channels_of(estimated[rows], found)
        change = new - np.float32(kept) * (old if old.ndim == 2 or found.ndim == 3 else channel_mean(old))
        change *= with_channels_of(reach[rows], found) - 1
        np.add(new, change, out=found[rows])
        np.maximum(found[rows], 0, out=found[rows])

    by_strips(strip, found.shape)
    return found


def placed_lamps(scene: Scene) -> list[PointLight]:
    """The lamps of a scene from which light falls off with the distance."""
    return [light for light in scene.lights if isinstance(light, PointLight) and light.radiance.any()]


def _body(x: FloatArray, y: FloatArray) -> FloatArray:
    """1 where a body stands below a head, 0 at the wall: clothes count as background, and are as near as the head."""
    top, half, growth = _SHOULDERS
    below = top - y
    wide = half + growth * np.maximum(below, 0) - np.abs(x)
    return np.asarray(smoothstep(below / _SOFT) * smoothstep(wide / _SOFT), np.float32)


def _falloff(scene: Scene, mesh: Mesh, shape: tuple[int, int], distance: float) -> FloatArray:
    """Light at the wall over light at the face, H x W or H x W x 3."""
    import cv2

    interocular = max(float(mesh.interocular), 1e-3)
    scale = min(1.0, _CELLS / max(*shape, 1))
    rows, columns = np.meshgrid(*(grid_middles(length, scale) for length in shape), indexing="ij")
    u, v = columns.ravel(), rows.ravel()
    flat = lifted_pixels(u, v, np.zeros(rows.size, np.float32), mesh.camera) / np.float32(interocular)
    depth = -distance * interocular * (1 - _body(flat[:, 0], flat[:, 1]))
    points = lifted_pixels(u, v, np.asarray(depth, np.float32), mesh.camera) / np.float32(interocular)
    placed, colored = placed_lamps(scene), scene.colored
    ambient = np.broadcast_to(np.asarray(scene.ambient, np.float32), 3)
    others = ambient + _OTHERS * sum((light.radiance for light in scene.lights if light not in placed), np.zeros(3))
    at_wall, at_face = np.tile(others, (rows.size, 1)), others.copy()
    for light in placed:
        far = np.linalg.norm(points - light.place, axis=1)
        at_wall += light.reach(far)[:, None] * light.radiance
        at_face += light.radiance
    ratio = np.minimum(at_wall / np.maximum(at_face, 1e-6), _MOST).reshape(*rows.shape, 3)
    small = np.asarray(ratio if colored else ratio.mean(axis=2), np.float32)
    return np.asarray(cv2.resize(small, shape[::-1], interpolation=cv2.INTER_LINEAR), np.float32)
