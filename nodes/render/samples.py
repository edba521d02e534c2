"""The points of a surface that are shaded: one for each cell of a grid over the picture.

The change of light is as smooth as the mesh's normals, so it is computed at these points and enlarged. They do not
depend on the scene, so an editor computes them once for all edits.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import Formerly, node
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
    resolution: Annotated[float, Field(ge=4, le=4096), Formerly("detail")] = 64,
) -> Samples:
    """The points at which a surface is shaded, on a grid of `resolution` points per inter-ocular distance.

    Args:
        estimated: the photo's own shading, H x W or H x W x 3, in the photo's encoding.
        mask: the face, H x W; brightness is compared over it.
        photo: its encoding is that of `estimated`.
        mesh: gives the size of the face and the camera. Without it every pixel is a sample, and near lights take all
            samples to be at the middle of the face.
        resolution: the grid is never finer than the picture.
    """
    interocular = max(float(mesh.interocular), 1e-3) if mesh is not None else 0.0
    height, width = picture = surface.normals.shape[:2]
    scale = resolution / interocular if interocular > 0 else 1.0
    v, u = grid_middles(height, scale), grid_middles(width, scale)
    covered = has_surface(surface.normals[v[:, None], u] if scale < 1 else surface.normals)
    rows, columns = np.nonzero(covered)
    pixels = v[rows] * width + u[columns]
    before = _at_pixels(estimated, pixels).astype(np.float32, copy=False)
    points = np.zeros((len(pixels), 3), np.float32)
    if mesh is not None:
        depth = _at_pixels(surface.depth, pixels)
        points = lifted_pixels(u[columns], v[rows], depth, mesh.camera) / np.float32(interocular)
    rim, rim_weights = _rim(covered)
    return Samples(
        picture=picture,
        grid=covered.shape,
        cells=rows * covered.shape[1] + columns,
        pixels=pixels,
        normals=_at_pixels(surface.normals, pixels),
        points=points,
        before=before,
        irradiance=np.maximum(decode_srgb(before) if photo.encoding == "srgb" else before, 0),
        weights=_at_pixels(mask, pixels),
        rim=rim,
        rim_weights=rim_weights,
        coverage=surface.coverage,
        encoding=photo.encoding,
    )


def _at_pixels(map_: FloatArray, pixels: NDArray[np.intp]) -> FloatArray:
    """Values of a map H x W (x c) at row-major indices: (n,) or (n, c)."""
    return map_.reshape(-1, *map_.shape[2:]).take(pixels, axis=0)


def _rim(covered: NDArray[np.bool_]) -> tuple[NDArray[np.intp], FloatArray]:
    """Row-major indices of the cells beside covered ones, and one over the number of covered neighbours of each."""
    import cv2

    if covered.size == 0:
        return np.zeros(0, np.intp), np.zeros(0, np.float32)
    neighbours = cv2.boxFilter(covered.astype(np.float32), -1, (3, 3), normalize=False, borderType=cv2.BORDER_CONSTANT)
    rim = np.flatnonzero(~covered & (neighbours > 0.5))
    return rim, np.asarray(1 / neighbours.reshape(-1).take(rim), np.float32)
