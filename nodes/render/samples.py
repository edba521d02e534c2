"""Where a surface is shaded: one point for each cell of a grid over the picture.

The change of light is as smooth as the mesh's normals, so it is found at these points and enlarged. Nothing here
depends on the scene: an editor computes it once and shades it for every edit.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.color import decode_srgb
from graphface.nodes.harmonics import has_surface
from graphface.nodes.pixel_grid import grid_middles, lifted_pixels
from graphface.nodes.types import FloatArray, Image, Mask, Mesh, Samples, Shading, Surface


@node("render.samples")
def samples(
    surface: Surface,
    estimated: Shading,
    mask: Mask,
    photo: Image,
    mesh: Mesh | None = None,
    *,
    detail: Annotated[float, Field(ge=4, le=4096)] = 64,
) -> Samples:
    """The points at which a surface is shaded, `detail` of them per inter-ocular distance.

    Args:
        estimated: the photo's own shading, H x W or H x W x 3, in the photo's encoding.
        mask: the face, over which brightness is compared.
        photo: gives the encoding.
        mesh: tells the size of the face and the camera; without it there is a point for every pixel, and near lights
            take all of them to be at the face's middle.
        detail: the grid is never finer than the picture.
    """
    unit = max(float(mesh.interocular), 1e-3) if mesh is not None else 0.0
    height, width = picture = surface.normals.shape[:2]
    scale = detail / unit if unit > 0 else 1.0
    v, u = grid_middles(height, scale), grid_middles(width, scale)
    covered = has_surface(surface.normals[v[:, None], u] if scale < 1 else surface.normals)
    down, across = np.nonzero(covered)
    pixels = v[down] * width + u[across]
    before = _taken(estimated, pixels).astype(np.float32, copy=False)
    rim, rim_weights = _rim(covered)
    return Samples(
        picture=picture,
        grid=covered.shape,
        cells=down * covered.shape[1] + across,
        pixels=pixels,
        normals=_taken(surface.normals, pixels),
        points=np.zeros((len(pixels), 3), np.float32)
        if mesh is None
        else lifted_pixels(u[across], v[down], _taken(surface.depth, pixels), mesh.camera) / np.float32(unit),
        before=before,
        irradiance=np.maximum(decode_srgb(before) if photo.encoding == "srgb" else before, 0),
        weights=_taken(mask, pixels),
        rim=rim,
        rim_weights=rim_weights,
        coverage=surface.coverage,
        encoding=photo.encoding,
    )


def _taken(map_: FloatArray, pixels: NDArray[np.intp]) -> FloatArray:
    return map_.reshape(-1, *map_.shape[2:]).take(pixels, axis=0)


def _rim(covered: NDArray[np.bool_]) -> tuple[NDArray[np.intp], FloatArray]:
    """Places of the cells beside covered ones, and one over the number of those."""
    import cv2

    if covered.size == 0:
        return np.zeros(0, np.intp), np.zeros(0, np.float32)
    around = cv2.boxFilter(covered.astype(np.float32), -1, (3, 3), normalize=False, borderType=cv2.BORDER_CONSTANT)
    rim = np.flatnonzero(~covered & (around > 0.5))
    return rim, np.asarray(1 / around.reshape(-1).take(rim), np.float32)
