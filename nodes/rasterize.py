"""Draw a mesh into the picture's pixels: which triangle each pixel sees, and where in it.

`cv2.triangleRasterize` decides visibility in C++; flat colors carry the triangle's number out of it. Everything else
is then computed exactly from that number: barycentric coordinates are affine in the pixel's position, so there is one
small matrix per triangle and no interpolation error from the rasterizer's own arithmetic.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.blur import blurred
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Mesh, Surface

_VIEW_ANGLE = 0.1
"""Field of view handed to OpenCV, radians; vertices are moved beforehand so that any value gives the same picture."""


_OFF_GRID = (1.3e-4, 0.7e-4)
"""Shift of the drawn triangles, pixels: an edge running exactly through pixel centres would belong to neither side."""


def rasterized(mesh: Mesh, size: tuple[int, int], *, smoothing: float = 0.03, area_floor: float = 1e-9) -> Surface:
    """A mesh drawn into a picture of `size` (height, width); see `surface.rasterize` for the rest."""
    height, width = size
    surface = _nothing_seen(height, width)
    pixels = np.asarray(mesh.camera.project(mesh.vertices.astype(np.float64)), np.float64)
    corners = pixels[mesh.triangles]  # T x 3 x 2
    area = _signed_area(corners)
    usable = np.isfinite(corners).all(axis=(1, 2)) & (np.abs(area) > area_floor)
    box = _bounding_box(corners[usable & (area > 0)], height, width)
    if box is None:
        warn("the mesh covers no pixel of the photo: normals, depth and coverage are empty")
        return surface
    x0, y0, x1, y1 = box

    drawn = np.flatnonzero(usable)
    z = mesh.vertices[mesh.triangles[drawn], 2]
    window = (y1 - y0, x1 - x0)
    seen = _visible_triangles(corners[drawn] - (x0, y0), z, window)
    holes = _enclosed(seen < 0)
    if holes.any():
        seen[holes] = _visible_triangles(corners[drawn] - (x0, y0), z, window, from_behind=True)[holes]
    if not (seen >= 0).any():
        warn("the mesh falls between the pixels: normals, depth and coverage are empty")
        return surface
    tables = _Tables(
        planes=_weight_planes(corners[drawn] - (x0, y0), area[drawn]),
        nearness=np.maximum(1 - z.T * mesh.camera.nearness, 1e-3) if mesh.camera.nearness != 0 else None,
        normals=np.ascontiguousarray(mesh.normals[mesh.triangles[drawn]].transpose(1, 2, 0), np.float32),
        z=np.ascontiguousarray(z.T, np.float32),
    )
    normals = np.zeros((*window, 3), np.float32)

    def look(rows: slice) -> None:
        """All maps at some rows of the window."""
        row, x = np.nonzero(seen[rows] >= 0)
        y = row + rows.start
        triangle = seen.reshape(-1).take(y * window[1] + x)
        weights = _barycentric(tables, triangle, x, y)
        normal = [_mixed(weights, tables.normals[:, axis], triangle) for axis in range(3)]
        normals.reshape(-1, 3)[y * window[1] + x] = np.stack(normal, axis=1)
        place = (y + y0) * width + (x + x0)
        surface.depth.reshape(-1)[place] = _mixed(weights, tables.z, triangle)
        surface.coverage.reshape(-1)[place] = 1
        surface.triangle.reshape(-1)[place] = drawn.take(triangle)
        surface.barycentric.reshape(-1, 3)[place] = np.stack(weights, axis=1)

    by_strips(look, (*window, 8))
    smooth = normals
    if smoothing * mesh.interocular > 0.3:  # a narrower Gaussian is a single pixel
        # Dividing by the blurred coverage is left to the normalization: it does not turn a vector.
        smooth = blurred(normals, smoothing * mesh.interocular)

    def normalize(rows: slice) -> None:
        part = smooth[rows]
        length = np.sqrt(_sum_of_channels(np.square(part)))
        inside = seen[rows] >= 0
        np.multiply(part, inside[..., None] / np.maximum(length, 1e-6), out=surface.normals[y0:y1, x0:x1][rows])

    by_strips(normalize, normals.shape)
    return surface


@dataclass(frozen=True)
class _Tables:
    """What is known of T triangles, one row for each number, since short rows are slow to look up.

    `planes` (2, 3, T): what the second and the third corner's weights are over the window's x, y and 1. Of each corner
    the `normals` (3, 3, T), the `z` (3, T) and the distance to the camera, `nearness` (3, T); None: all are equal.
    """

    planes: NDArray[np.float64]
    nearness: NDArray[np.floating[Any]] | None
    normals: NDArray[np.float32]
    z: NDArray[np.float32]


def _nothing_seen(height: int, width: int) -> Surface:
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


def _bounding_box(corners: NDArray[np.float64], height: int, width: int) -> tuple[int, int, int, int] | None:
    """The pixels x0 <= x < x1, y0 <= y < y1 that the triangles may touch, or None where there are none."""
    if corners.size == 0:
        return None
    frame = np.array([width, height])
    low = np.clip(np.floor(corners.min(axis=(0, 1))), 0, frame).astype(int)
    high = np.clip(np.ceil(corners.max(axis=(0, 1))) + 1, 0, frame).astype(int)
    return None if (high <= low).any() else (int(low[0]), int(low[1]), int(high[0]), int(high[1]))


def _enclosed(uncovered: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The uncovered pixels from which no way leads out of the window."""
    import cv2

    padded = np.pad(uncovered, 1, constant_values=True)
    _, region = cv2.connectedComponents(padded.astype(np.uint8), connectivity=4)
    enclosed: NDArray[np.bool_] = padded & (region != region[0, 0])
    return enclosed[1:-1, 1:-1]


def _visible_triangles(
    corners: NDArray[np.float64], z: NDArray[np.floating[Any]], size: tuple[int, int], from_behind: bool = False
) -> NDArray[np.int32]:
    """Number of the nearest triangle at each pixel of a window (height, width), -1 where there is none.

    OpenCV only knows a perspective camera at the origin looking along -z, with the window's corners at +-0.5 pixel
    beyond the outermost centres. Putting each vertex at its own distance d - z and scaling its x and y by that
    distance over d lands it on the wanted pixel exactly.
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
    scale = 1 / area[:, None]  # triangles without area were left out before
    slopes = np.stack([np.stack([c[:, 1], -c[:, 0]], 1), np.stack([-b[:, 1], b[:, 0]], 1)], axis=1) * -scale[..., None]
    offsets = -np.einsum("tkx,tx->tk", slopes, first)  # float64: differences of large numbers
    return np.ascontiguousarray(np.concatenate([slopes, offsets[..., None]], axis=2).transpose(1, 2, 0))


def _barycentric(
    tables: _Tables, triangle: NDArray[np.int32], x: NDArray[np.intp], y: NDArray[np.intp]
) -> list[NDArray[np.float32]]:
    """Barycentric coordinates, three of (n,), of pixel centres in the triangles they see."""
    weights = [np.zeros(0, np.float32)]
    for slope_x, slope_y, offset in tables.planes:
        weight = slope_x.take(triangle) * x + slope_y.take(triangle) * y + offset.take(triangle)
        weights.append(np.clip(weight, 0, 1).astype(np.float32))
    weights[0] = np.clip(1 - weights[1] - weights[2], 0, 1)
    if tables.nearness is not None:
        # Equal steps in the picture are unequal steps on a tilted triangle: weigh each corner by one over its distance.
        weights = [
            (w / near.take(triangle)).astype(np.float32) for w, near in zip(weights, tables.nearness, strict=True)
        ]
    total = np.maximum(weights[0] + weights[1] + weights[2], 1e-12)
    return [weight / total for weight in weights]


def _mixed(
    weights: list[NDArray[np.float32]], of_corner: NDArray[np.float32], triangle: NDArray[np.int32]
) -> NDArray[np.float32]:
    """A number of each corner (3, T), interpolated at n points."""
    return sum(
        (weight * values.take(triangle) for weight, values in zip(weights, of_corner, strict=True)),
        start=np.zeros(1, np.float32),
    )


def _sum_of_channels(values: NDArray[np.float32]) -> NDArray[np.float32]:
    """(..., 3) to (..., 1); several times faster than `sum` over so short an axis."""
    return values[..., 0:1] + values[..., 1:2] + values[..., 2:3]
