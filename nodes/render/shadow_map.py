"""How much of a light each point of a surface sees, from depth buffers drawn at the light's place.

A shadow map (Williams 1978) says how far the light gets in each direction; a point further away than that lies in
shadow. Looking a point up among four texels and mixing the four verdicts, not the depths, is percentage-closer
filtering (Reeves, Salesin and Cook 1987). A light of some size is a handful of places on a disc, one small map each:
the penumbra widens with the distance between the edge and what it falls on, as it should.

A point is compared from a little above the surface, along its normal and towards the light. Too little and facets
shade themselves (acne); too much and the light leaks under a nose. The lift is in face units, so neither depends on
the picture's size; a map too coarse for it raises it and shows less shadow rather than a wrong one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.strips import side_by_side
from graphface.nodes.types import FloatArray

_NEAR = 0.05
"""Nothing nearer to the light than this casts a shadow, inter-ocular distances."""


_TEXELS = 1.5
"""Least lift in texels. A texel off across the light is its width times the tangent of the angle of incidence off in
depth; lifting a point by d along its normal gains d over the cosine, which is more at every angle."""


_AT_A_TIME = 1 << 14
"""Points looked up together, so that what is computed for them stays in the processor's cache."""


_WIDEST = np.radians(150.0)
"""Field of view of a map whose light stands in or at the face."""


def lit_share(
    points: FloatArray,
    normals: FloatArray,
    places: FloatArray,
    vertices: FloatArray,
    triangles: NDArray[np.int32],
    *,
    resolution: int,
    lift: float,
) -> FloatArray:
    """The share of a light's irradiance that reaches each point past the mesh: (n,), 0 in full shadow to 1.

    Args:
        points, normals: (n, 3), in inter-ocular distances and unit length.
        places: (k, 3) points on the light.
        vertices, triangles: what casts the shadow; triangles without area cast none.
        resolution: texels along a side of each map.
        lift: how far above the surface a point is compared.
    """
    caster = _Caster(vertices, triangles)
    maps: list[_ShadowMap | None] = [None] * len(places)

    def draw(index: int) -> None:
        maps[index] = _ShadowMap(places[index], caster, resolution)

    side_by_side(draw, range(len(places)))
    drawn = [map_ for map_ in maps if map_ is not None]
    shares = np.empty(len(points), np.float32)

    def light(start: int) -> None:
        some = slice(start, start + _AT_A_TIME)
        shares[some] = _share(drawn, points[some], normals[some], lift)

    side_by_side(light, range(0, len(points), _AT_A_TIME))
    return shares


def _share(maps: list[_ShadowMap], points: FloatArray, normals: FloatArray, lift: float) -> FloatArray:
    """`lit_share` past maps that are drawn."""
    received = np.zeros(len(points), np.float32)
    possible = np.full(len(points), np.float32(1e-6))
    for map_ in maps:
        towards = map_.place - points
        distance = np.sqrt(np.einsum("nc,nc->n", towards, towards))
        cosine = np.einsum("nc,nc->n", towards, normals) / np.maximum(distance, np.float32(1e-4))
        facing = np.flatnonzero(cosine > 0)
        if not len(facing):
            continue
        above = np.float32(max(lift, _TEXELS * map_.texel))
        cosine = cosine.take(facing)
        seen = map_.sees(points.take(facing, axis=0) + normals.take(facing, axis=0) * above, above / 2)
        received[facing] += cosine * seen
        possible[facing] += cosine
    return np.asarray((received + np.float32(1e-6)) / possible, np.float32)


def disc(towards: FloatArray, radius: float, count: int) -> FloatArray:
    """`count` offsets (count, 3) spread evenly over a disc across a direction: Vogel's sunflower. One is the middle."""
    across = np.cross(towards, (0.0, 1.0, 0.0) if abs(towards[1]) < 0.9 else (1.0, 0.0, 0.0))
    across /= max(float(np.linalg.norm(across)), 1e-6)
    index = np.arange(count)
    far = radius * np.sqrt((index + 0.5) / count) if count > 1 else np.zeros(1)
    turn = index * np.pi * (3 - np.sqrt(5.0))
    offsets = (far * np.cos(turn))[:, None] * across + (far * np.sin(turn))[:, None] * np.cross(towards, across)
    return np.asarray(offsets, np.float32)


class _Caster:
    """A mesh and the ball around it."""

    def __init__(self, vertices: FloatArray, triangles: NDArray[np.int32]) -> None:
        self.vertices, self.triangles = vertices, triangles
        self.middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
        self.reach = float(np.sqrt(np.square(vertices - self.middle).sum(axis=1).max()))


class _ShadowMap:
    """The depth that a light sees in each direction: a camera at the light's place, its view just around the mesh."""

    def __init__(self, place: FloatArray, caster: _Caster, resolution: int) -> None:
        import cv2

        middle, reach = caster.middle, caster.reach
        self.place = place
        self._axes = _looking(middle - place)
        seen = self._from_light(caster.vertices)
        away = float(np.linalg.norm(middle - place))
        near, far = max(away - 1.1 * reach, _NEAR), away + 1.1 * reach + 2 * _NEAR
        self._slope = _opening(seen, near)
        self.texel = 2 * self._slope * max(away, near) / resolution
        self._resolution = resolution
        depth = np.full((resolution, resolution), far, np.float32)
        settings = cv2.TriangleRasterizeSettings()
        settings.setCullingMode(cv2.RASTERIZE_CULLING_NONE)
        view_angle = 2 * np.arctan(self._slope)
        pose = np.eye(4, dtype=np.float32)
        cv2.triangleRasterizeDepth(seen, caster.triangles, depth, pose, view_angle, near, far, settings)
        self._depth = np.pad(depth, 2, constant_values=np.float32(np.inf))

    def sees(self, points: FloatArray, bias: np.float32) -> FloatArray:
        """Percentage-closer filtering over the four texels around each point; what the map does not cover is lit."""
        seen = self._from_light(points)
        depth = -seen[:, 2]
        scale = self._resolution / 2 / (self._slope * np.maximum(depth, np.float32(_NEAR)))
        middle = np.float32((self._resolution - 1) / 2)
        texels = (middle + seen[:, 0] * scale, middle - seen[:, 1] * scale)
        column, row = (np.asarray(np.clip(v, -1, self._resolution), np.float32) for v in texels)
        left, top = np.floor(column), np.floor(row)
        right_share, low_share = column - left, row - top
        below = self._depth.shape[1]
        first = (top.astype(np.intp) + 2) * below + left.astype(np.intp) + 2
        flat = self._depth.reshape(-1)
        limit = depth - bias

        def passes(step: int) -> FloatArray:
            return np.asarray(flat.take(first + step) >= limit, np.float32)

        upper = passes(0) * (1 - right_share) + passes(1) * right_share
        lower = passes(below) * (1 - right_share) + passes(below + 1) * right_share
        return np.asarray(upper * (1 - low_share) + lower * low_share, np.float32)

    def _from_light(self, points: FloatArray) -> FloatArray:
        """In the light's own frame: x right, y up, -z ahead."""
        turned: FloatArray = np.ascontiguousarray((points - self.place) @ self._axes.T, np.float32)
        return turned


def _looking(ahead: FloatArray) -> FloatArray:
    """Rows are the right, up and backward unit vectors of a camera that looks `ahead`."""
    length = float(np.linalg.norm(ahead))
    back = -np.asarray(ahead, np.float64) / length if length > 1e-6 else np.array([0.0, 0.0, 1.0])
    right = np.cross((0.0, 1.0, 0.0) if abs(back[1]) < 0.9 else (1.0, 0.0, 0.0), back)
    right /= max(float(np.linalg.norm(right)), 1e-6)
    return np.stack([right, np.cross(back, right), back]).astype(np.float32)


def _opening(seen: FloatArray, near: float) -> float:
    """Tangent of half the view angle that holds all vertices ahead of the light, with a texel or two to spare."""
    ahead = -seen[:, 2]
    visible = ahead > near
    most = float(np.tan(_WIDEST / 2))
    if not visible.all() or not visible.any():
        return most
    slopes = np.abs(seen[:, :2]).max(axis=1) / ahead
    return min(max(1.05 * float(slopes.max()), 1e-4), most)
