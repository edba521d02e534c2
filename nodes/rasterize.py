"""A mesh drawn into the picture's pixels: the visible triangle of each pixel, and the position in it.

`cv2.triangleRasterize` computes visibility in C++ and returns the triangle's number as a flat color. Everything else is
computed exactly from that number: barycentric coordinates are affine in the pixel's position, so there is one small
matrix per triangle and no interpolation error of the rasterizer.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.blur import blurred
from graphface.nodes.bounding_box import Box
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Mesh, Surface

_VIEW_ANGLE = 0.1
"""Field of view for OpenCV, radians; vertices are moved beforehand so that any value gives the same picture."""


_OFF_GRID = (1.3e-4, 0.7e-4)
"""Shift of the drawn triangles, pixels: an edge exactly through pixel centers would belong to neither side."""


def rasterized(mesh: Mesh, size: tuple[int, int], *, smoothing: float = 0.03, area_floor: float = 1e-9) -> Surface:
    """A mesh drawn into a picture of `size` (height, width); see `surface.rasterize` for the rest."""
    surface = _empty_surface(*size)
    pixels = np.asarray(mesh.camera.project(mesh.vertices.astype(np.float64)), np.float64)
    corners = pixels[mesh.triangles]  # T x 3 x 2
    area = _signed_area(corners)
    usable = np.isfinite(corners).all(axis=(1, 2)) & (np.abs(area) > area_floor)
    box = _bounding_box(corners[usable & (area > 0)], *size)
    if box is None:
        warn("the mesh covers no pixel of the photo: normals, depth and coverage are empty")
        return surface
    drawn = np.flatnonzero(usable)
    corners = corners[drawn] - (box[1].start, box[0].start)
    z = mesh.vertices[mesh.triangles[drawn], 2]
    visible = _visible_triangles(corners, z, (box[0].stop - box[0].start, box[1].stop - box[1].start))
    if not (visible >= 0).any():
        warn("the mesh falls between the pixels: normals, depth and coverage are empty")
        return surface
    tables = _Tables(
        planes=_weight_planes(corners, area[drawn]),
        distance=np.maximum(1 - z.T * mesh.camera.nearness, 1e-3) if mesh.camera.nearness != 0 else None,
        normals=np.ascontiguousarray(mesh.normals[mesh.triangles[drawn]].transpose(1, 2, 0), np.float32),
        z=np.ascontiguousarray(z.T, np.float32),
    )
    normals = _interpolate(surface, visible, tables, drawn, box)
    if smoothing * mesh.interocular > 0.3:  # a narrower Gaussian is a single pixel
        # Dividing by the blurred coverage is left to the normalization, since it does not rotate a vector.
        normals = blurred(normals, smoothing * mesh.interocular)
    _normalize(normals, visible >= 0, surface.normals[box])
    return surface


@dataclass(frozen=True)
class _Tables:
    """Numbers of T triangles, the triangle last, since looking up short rows is slow.

    `planes` (2, 3, T): coefficients of the second and the third corner's weights over the window's x, y and 1. At each
    corner the `normals` (3, 3, T), the `z` (3, T) and the `distance` to the camera (3, T), relative to that of the
    origin; None: all are 1.
    """

    planes: NDArray[np.float64]
    distance: NDArray[np.floating[Any]] | None
    normals: NDArray[np.float32]
    z: NDArray[np.float32]


def _interpolate(
    surface: Surface, visible: NDArray[np.int32], tables: _Tables, drawn: NDArray[np.intp], box: Box
) -> NDArray[np.float32]:
    """Write every map of the surface but the normals, and return those, interpolated and not yet of length 1.

    Args:
        visible: of a window, numbers into `drawn`, which has the mesh's numbers of the triangles that were drawn.
        box: the window in the surface.
    """
    height, width = visible.shape
    normals = np.zeros((height, width, 3), np.float32)

    def interpolate(rows: slice) -> None:
        row, x = np.nonzero(visible[rows] >= 0)
        y = row + rows.start
        triangle = visible.reshape(-1).take(y * width + x)
        weights = _barycentric(tables, triangle, x, y)
        normal = [_mixed(weights, tables.normals[:, axis], triangle) for axis in range(3)]
        normals.reshape(-1, 3)[y * width + x] = np.stack(normal, axis=1)
        pixel = (y + box[0].start) * surface.depth.shape[1] + (x + box[1].start)
        surface.depth.reshape(-1)[pixel] = _mixed(weights, tables.z, triangle)
        surface.coverage.reshape(-1)[pixel] = 1
        surface.triangle.reshape(-1)[pixel] = drawn.take(triangle)
        surface.barycentric.reshape(-1, 3)[pixel] = np.stack(weights, axis=1)

    by_strips(interpolate, (height, width, 8))
    return normals


def _normalize(normals: NDArray[np.float32], inside: NDArray[np.bool_], out: NDArray[np.float32]) -> None:
    """Write unit normals inside and 0 outside."""

    def normalize(rows: slice) -> None:
        part = normals[rows]
        length = np.sqrt(_sum_of_channels(np.square(part)))
        np.multiply(part, inside[rows, :, None] / np.maximum(length, 1e-6), out=out[rows])

    by_strips(normalize, normals.shape)


def _empty_surface(height: int, width: int) -> Surface:
    return Surface(
        normals=np.zeros((height, width, 3), np.float32),
        depth=np.zeros((height, width), np.float32),
        coverage=np.zeros((height, width), np.float32),
        triangle=np.full((height, width), -1, np.int32),
        barycentric=np.zeros((height, width, 3), np.float32),
    )


def _signed_area(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Twice the area of each triangle (T x 3 x 2) in the picture, positive where it faces the camera."""
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    twice: NDArray[np.float64] = a[:, 1] * b[:, 0] - a[:, 0] * b[:, 1]  # y points down in the picture
    return twice


def _bounding_box(corners: NDArray[np.float64], height: int, width: int) -> Box | None:
    """The pixels that the triangles may touch, or None where there are none."""
    if corners.size == 0:
        return None
    frame = np.array([width, height])
    low = np.clip(np.floor(corners.min(axis=(0, 1))), 0, frame).astype(int)
    high = np.clip(np.ceil(corners.max(axis=(0, 1))) + 1, 0, frame).astype(int)
    return None if (high <= low).any() else (slice(int(low[1]), int(high[1])), slice(int(low[0]), int(high[0])))


def _visible_triangles(
    corners: NDArray[np.float64], z: NDArray[np.floating[Any]], size: tuple[int, int]
) -> NDArray[np.int32]:
    """Number of the nearest triangle at each pixel of a window (height, width), -1 where there is none.

    Triangles that face away from the camera are drawn only where the others leave a hole.
    """
    visible = _nearest_triangles(corners, z, size)
    holes = _enclosed(visible < 0)
    if holes.any():
        visible[holes] = _nearest_triangles(corners, z, size, from_behind=True)[holes]
    return visible


def _enclosed(uncovered: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The uncovered pixels that are not connected to the edge of the window."""
    import cv2

    padded = np.pad(uncovered, 1, constant_values=True)
    _, region = cv2.connectedComponents(padded.astype(np.uint8), connectivity=4)
    enclosed: NDArray[np.bool_] = padded & (region != region[0, 0])
    return enclosed[1:-1, 1:-1]


def _nearest_triangles(
    corners: NDArray[np.float64], z: NDArray[np.floating[Any]], size: tuple[int, int], from_behind: bool = False
) -> NDArray[np.int32]:
    """`_visible_triangles`, of the triangles that face the camera or (`from_behind`) of all.

    OpenCV supports only a perspective camera at the origin that looks along -z, whose frame ends half a pixel beyond
    the outermost centers. A vertex is put at its own distance d - z, with x and y scaled by that distance over d. So it
    is projected onto its pixel exactly.
    """
    import cv2

    height, width = size
    reach = max(float(np.ptp(z)), 1.0)
    middle = float(z.min() + z.max()) / 2
    distance = max(height / 2 / np.tan(_VIEW_ANGLE / 2), 4 * reach)
    view_angle = 2 * np.arctan(height / 2 / distance)
    away = distance - (z.reshape(-1) - middle)
    flat = corners.reshape(-1, 2) + _OFF_GRID
    vertices = np.empty((len(flat), 3), np.float32)
    vertices[:, 0] = (flat[:, 0] - (width - 1) / 2) * away / distance
    vertices[:, 1] = ((height - 1) / 2 - flat[:, 1]) * away / distance
    vertices[:, 2] = -away

    count = len(corners)
    numbers = np.zeros((3 * count, 3), np.float32)
    numbers[:, 0] = np.repeat((np.arange(count) + 1) / count, 3)  # OpenCV promises colors in [0, 1] only
    color = np.zeros((height, width, 3), np.float32)
    depth = np.full((height, width), distance + 2 * reach, np.float32)
    indices = np.arange(3 * count, dtype=np.int32).reshape(-1, 3)
    settings = cv2.TriangleRasterizeSettings()
    settings.setShadingType(cv2.RASTERIZE_SHADING_FLAT)
    settings.setCullingMode(cv2.RASTERIZE_CULLING_NONE if from_behind else cv2.RASTERIZE_CULLING_CW)
    pose = np.eye(4, dtype=np.float32)
    near, far = distance - 2 * reach, distance + 2 * reach
    cv2.triangleRasterize(vertices, indices, numbers, color, depth, pose, view_angle, near, far, settings)
    return np.rint(color[..., 0] * count).astype(np.int32) - 1


def _weight_planes(corners: NDArray[np.float64], area: NDArray[np.float64]) -> NDArray[np.float64]:
    """Weight of the second and the third corner = plane . (x, y, 1), per triangle: (2, 3, T)."""
    first, b, c = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    scale = 1 / area[:, None]  # triangles without area are not drawn
    slopes = np.stack([np.stack([c[:, 1], -c[:, 0]], 1), np.stack([-b[:, 1], b[:, 0]], 1)], axis=1) * -scale[..., None]
    offsets = -np.einsum("tkx,tx->tk", slopes, first)  # float64: differences of large numbers
    return np.ascontiguousarray(np.concatenate([slopes, offsets[..., None]], axis=2).transpose(1, 2, 0))


def _barycentric(
    tables: _Tables, triangle: NDArray[np.int32], x: NDArray[np.intp], y: NDArray[np.intp]
) -> list[NDArray[np.float32]]:
    """Barycentric coordinates, three of (n,), of pixel centers in their visible triangles."""
    weights = [np.zeros(0, np.float32)]
    for slope_x, slope_y, offset in tables.planes:
        weight = slope_x.take(triangle) * x + slope_y.take(triangle) * y + offset.take(triangle)
        weights.append(np.clip(weight, 0, 1).astype(np.float32))
    weights[0] = np.clip(1 - weights[1] - weights[2], 0, 1)
    if tables.distance is not None:
        # In perspective, weights are affine in the picture only after division by each corner's distance.
        weights = [
            (w / distance.take(triangle)).astype(np.float32)
            for w, distance in zip(weights, tables.distance, strict=True)
        ]
    total = np.maximum(weights[0] + weights[1] + weights[2], 1e-12)
    return [weight / total for weight in weights]


def _mixed(
    weights: list[NDArray[np.float32]], of_corner: NDArray[np.float32], triangle: NDArray[np.int32]
) -> NDArray[np.float32]:
    """Values at the corners (3, T), interpolated at n points."""
    return sum(
        (weight * values.take(triangle) for weight, values in zip(weights, of_corner, strict=True)),
        start=np.zeros(1, np.float32),
    )


def _sum_of_channels(values: NDArray[np.float32]) -> NDArray[np.float32]:
    """(..., 3) to (..., 1); several times faster than `sum` over so short an axis."""
    return values[..., 0:1] + values[..., 1:2] + values[..., 2:3]
