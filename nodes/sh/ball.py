"""A light on a matt white ball."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.sh.render import render
from graphface.nodes.types import FloatArray, Image, Lighting, Normals


@node("sh.ball")
def ball(
    light: Lighting,
    *,
    size: Annotated[int, Field(ge=2, le=4096)] = 256,
    brightness: Annotated[float, Field(gt=0, le=100)] = 1.0,
) -> Image:
    """A picture of a white sphere under a light, to look at a result of `sh.fit`; black around it.

    Args:
        light: in the encoding that it was fitted in; the picture is sRGB, as in the shipped graphs.
        size: side of the picture in pixels.
        brightness: factor of the shading.

    Returns:
        size x size, clipped to [0, 1]; alpha is the antialiased disc of the sphere.
    """
    normals, coverage = _hemisphere(size)
    shading = np.clip(render(light, normals) * np.float32(brightness), 0, 1)
    colored = shading if shading.ndim == 3 else np.repeat(shading[..., None], 3, axis=2)
    return Image(pixels=colored * coverage[..., None], alpha=coverage)


def _hemisphere(size: int) -> tuple[Normals, FloatArray]:
    """Normals and coverage of a sphere that fills the square.

    Beyond the rim normals continue by a pixel, for the antialiased edge.
    """
    radius = size / 2
    y, x = np.mgrid[0:size, 0:size].astype(np.float32)
    x, y = (x + 0.5 - radius) / radius, (radius - y - 0.5) / radius
    distance = np.hypot(x, y)
    length = np.maximum(distance, 1)
    z = np.sqrt(np.maximum(1 - distance**2, 0))
    coverage = np.clip((1 - distance) * radius + 0.5, 0, 1)
    normals = np.stack([x / length, y / length, z], axis=2)
    normals[coverage == 0] = 0
    return normals, coverage
