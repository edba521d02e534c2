"""The visible share of a light at points of a surface, by depth buffers drawn from the light's position.

A shadow map (Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978) holds how far the light travels in
each direction; a point further away lies in shadow. Percentage-closer filtering (Reeves, Salesin, Cook, Rendering
Antialiased Shadows with Depth Maps, SIGGRAPH 1987) compares a point with the four texels around it and interpolates the
four results of the comparison, not the depths. A light of some size is a number of points on a disc with one small map
each. So the penumbra widens with the distance between an edge and the surface that its shadow falls on.

A point is compared from a small height above the surface, along its normal: the bias. With too small a bias facets
shadow themselves (acne); with too large a bias light leaks under a nose. It is measured in inter-ocular distances, so
neither depends on the picture's size. A map that is too coarse for the bias raises it, and shows less shadow instead of
a wrong one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.strips import in_parallel
from graphface.nodes.types import FloatArray

_NEAREST = 0.05
"""Inter-ocular distances; what is nearer to the light casts no shadow."""


_BIAS_TEXELS = 1.5
"""Least bias in texels. An error of one texel across the light is, in depth, the texel's width times the tangent of the
angle of incidence. A bias of d along the normal gains d over the cosine, which is more at every angle."""


_CHUNK = 1 << 14
"""Points looked up together, so that what is computed for them stays in the processor's cache."""


_WIDEST_VIEW = np.radians(150.0)
"""Field of view of a map whose light stands in or at the face."""


def visible_share(
    points: FloatArray,
    normals: FloatArray,
    light_points: FloatArray,
    vertices: FloatArray,
    triangles: NDArray[np.int32],
    *,
    resolution: int,
    bias: float,
) -> FloatArray:
    """The share of a light's irradiance that reaches each point past a mesh.

    Args:
        points: float32 (n, 3), in inter-ocular distances. normals: float32 (n, 3), unit length.
        light_points: float32 (k, 3), points on the light.
        vertices, triangles: the mesh that casts the shadow; triangles without area cast none.
        resolution: texels along a side of each map.
        bias: height above the surface at which a point is compared, inter-ocular distances.

    Returns:
        float32 (n,), 0 in full shadow to 1.
    """
    caster = _Caster(vertices, triangles)
    maps: list[_ShadowMap | None] = [None] * len(light_points)

    def draw(index: int) -> None:
        maps[index] = _ShadowMap(light_points[index], caster, resolution)

    in_parallel(draw, range(len(light_points)))
    drawn = [map_ for map_ in maps if map_ is not None]
    shares = np.empty(len(points), np.float32)

    def look_up(start: int) -> None:
        chunk = slice(start, start + _CHUNK)
        shares[chunk] = _share(drawn, points[chunk], normals[chunk], bias)

    in_parallel(look_up, range(0, len(points), _CHUNK))
    return shares


def disc(towards: FloatArray, radius: float, count: int) -> FloatArray:
    """Points spread evenly over a disc across a direction (Vogel's sunflower): offsets float32 (count, 3).

    A single point is the middle of the disc.
    """
    across = np.cross(towards, (0.0, 1.0, 0.0) if abs(towards[1]) < 0.9 else (1.0, 0.0, 0.0))
    across /= max(float(np.linalg.norm(across)), 1e-6)
    index = np.arange(count)
    radii = radius * np.sqrt((index + 0.5) / count) if count > 1 else np.zeros(1)
    angle = index * np.pi * (3 - np.sqrt(5.0))
    offsets = (radii * np.cos(angle))[:, None] * across + (radii * np.sin(angle))[:, None] * np.cross(towards, across)
    return np.asarray(offsets, np.float32)


def _share(maps: list[_ShadowMap], points: FloatArray, normals: FloatArray, bias: float) -> FloatArray:
    """The mean visibility of the light's points, weighted by the cosines of their incidence."""
    received = np.zeros(len(points), np.float32)
    possible = np.full(len(points), np.float32(1e-6))
    for map_ in maps:
        towards = map_.position - points
        distance = np.sqrt(np.einsum("nc,nc->n", towards, towards))
        cosine = np.einsum("nc,nc->n", towards, normals) / np.maximum(distance, np.float32(1e-4))
        facing = np.flatnonzero(cosine > 0)
        if not len(facing):
            continue
        height = np.float32(max(bias, _BIAS_TEXELS * map_.texel))
        cosine = cosine.take(facing)
        raised = points.take(facing, axis=0) + normals.take(facing, axis=0) * height
        received[facing] += cosine * map_.visibility(raised, height / 2)
        possible[facing] += cosine
    return np.asarray((received + np.float32(1e-6)) / possible, np.float32)


class _Caster:
    """A mesh and a sphere around it."""

    def __init__(self, vertices: FloatArray, triangles: NDArray[np.int32]) -> None:
        self.vertices, self.triangles = vertices, triangles
        self.center = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
        self.radius = float(np.sqrt(np.square(vertices - self.center).sum(axis=1).max()))


class _ShadowMap:
    """The depth buffer of a camera at a light's position that views just the mesh."""

    def __init__(self, position: FloatArray, caster: _Caster, resolution: int) -> None:
        import cv2

        center, radius = caster.center, caster.radius
        self.position = position
        self._axes = _camera_axes(center - position)
        vertices = self._in_light_frame(caster.vertices)
        distance = float(np.linalg.norm(center - position))
        near, far = max(distance - 1.1 * radius, _NEAREST), distance + 1.1 * radius + 2 * _NEAREST
        self._tangent = _half_view_tangent(vertices, near)
        self.texel = 2 * self._tangent * max(distance, near) / resolution
        self._resolution = resolution
        depth = np.full((resolution, resolution), far, np.float32)
        settings = cv2.TriangleRasterizeSettings()
        settings.setCullingMode(cv2.RASTERIZE_CULLING_NONE)
        view_angle = 2 * np.arctan(self._tangent)
        pose = np.eye(4, dtype=np.float32)
        cv2.triangleRasterizeDepth(vertices, caster.triangles, depth, pose, view_angle, near, far, settings)
        self._depth = np.pad(depth, 2, constant_values=np.float32(np.inf))

    def visibility(self, points: FloatArray, bias: np.float32) -> FloatArray:
        """Percentage-closer filtering over the four texels around each point: float32 (n,), 1 beyond the map's edge."""
        in_frame = self._in_light_frame(points)
        depth = -in_frame[:, 2]
        scale = self._resolution / 2 / (self._tangent * np.maximum(depth, np.float32(_NEAREST)))
        middle = np.float32((self._resolution - 1) / 2)
        texels = (middle + in_frame[:, 0] * scale, middle - in_frame[:, 1] * scale)
        column, row = (np.asarray(np.clip(v, -1, self._resolution), np.float32) for v in texels)
        left, top = np.floor(column), np.floor(row)
        right_weight, lower_weight = column - left, row - top
        stride = self._depth.shape[1]
        first = (top.astype(np.intp) + 2) * stride + left.astype(np.intp) + 2
        buffer = self._depth.reshape(-1)
        limit = depth - bias

        def lit(step: int) -> FloatArray:
            return np.asarray(buffer.take(first + step) >= limit, np.float32)

        upper = lit(0) * (1 - right_weight) + lit(1) * right_weight
        lower = lit(stride) * (1 - right_weight) + lit(stride + 1) * right_weight
        return np.asarray(upper * (1 - lower_weight) + lower * lower_weight, np.float32)

    def _in_light_frame(self, points: FloatArray) -> FloatArray:
        """Points (n, 3) in the frame of the light's camera: x right, y up, -z ahead."""
        turned: FloatArray = np.ascontiguousarray((points - self.position) @ self._axes.T, np.float32)
        return turned


def _camera_axes(ahead: FloatArray) -> FloatArray:
    """The right, up and backward unit vectors of a camera that looks `ahead`, as rows of float32 (3, 3)."""
    length = float(np.linalg.norm(ahead))
    back = -np.asarray(ahead, np.float64) / length if length > 1e-6 else np.array([0.0, 0.0, 1.0])
    right = np.cross((0.0, 1.0, 0.0) if abs(back[1]) < 0.9 else (1.0, 0.0, 0.0), back)
    right /= max(float(np.linalg.norm(right)), 1e-6)
    return np.stack([right, np.cross(back, right), back]).astype(np.float32)


def _half_view_tangent(vertices: FloatArray, near: float) -> float:
    """Tangent of half the field of view that holds all vertices ahead of the light, with a margin of 5 %."""
    ahead = -vertices[:, 2]
    visible = ahead > near
    widest = float(np.tan(_WIDEST_VIEW / 2))
    if not visible.all() or not visible.any():
        return widest
    slopes = np.abs(vertices[:, :2]).max(axis=1) / ahead
    return min(max(1.05 * float(slopes.max()), 1e-4), widest)
