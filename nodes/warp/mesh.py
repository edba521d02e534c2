"""Correspondence through two aligned meshes (paper, "Face geometry"): same triangle, same barycentric coordinates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import UsageError, node, warn
from graphface.nodes.blur import blurred
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Correspondence, FloatArray, Mask, Mesh, Pins, Surface
from graphface.nodes.vertex_visibility import unoccluded, vertex_pixels

Hidden = Literal["mirror", "input"]


_INVISIBLE = np.float32(0.05)
"""Added to both visibilities before they are divided: where neither photo shows a point, they are equally good."""


_ENOUGH = 0.7
"""Validity from which on the mirror image is not needed."""


_FADE = 0.04
"""Sigma, in inter-ocular distances, of the transition from a point to its mirror image. It lies on the side where the
point is visible, because on the other side the reference may show anything."""


_DEPTH_TOLERANCE = 0.12
"""Depth behind another part of the face, in inter-ocular distances, from which on a vertex begins to be occluded."""


_OUTLINE = 0.06
"""Distance from the mesh's outline, in inter-ocular distances, below which a pixel may show what is behind the face."""


@node("warp.mesh")
def mesh(
    surface: Surface,
    mesh: Mesh,
    reference_surface: Surface,
    reference_mesh: Mesh,
    mask: Mask | None = None,
    reference_mask: Mask | None = None,
    pins: Pins | None = None,
    *,
    hidden: Hidden = "mirror",
    facing: Annotated[float, Field(gt=0, lt=1)] = 0.4,
    pin_reach: Annotated[float, Field(gt=0, le=5)] = 0.3,
) -> Correspondence:
    """Where each pixel's point of the input's face lies in the reference.

    A place is valid where the reference shows the point as well as the input does.

    Args:
        surface, mesh: the input's. reference_surface, reference_mesh: the reference's, of the same triangles.
        mask, reference_mask: the input's visible skin, and the reference's; without the second, all is visible.
        pins: correspondences set by hand; their corrections fade out over `pin_reach` inter-ocular distances.
        hidden: what replaces points that the reference does not show: "mirror" their mirror images, "input" nothing, so
            that the input stays.
        facing: cosine between normal and view from which on a surface counts as visible; below half of it, it does not.

    Raises:
        UsageError: the two meshes have different triangles.
    """
    if not np.array_equal(mesh.triangles, reference_mesh.triangles):
        raise UsageError(
            f"warp.mesh: the meshes differ ({len(mesh.triangles)} and {len(reference_mesh.triangles)} triangles); "
            "use the same geometry node for both photos"
        )
    size = (reference_surface.coverage.shape[0], reference_surface.coverage.shape[1])
    inside = (surface.coverage > 0.5).astype(np.float32)
    if not inside.any():
        warn("warp.mesh: the input's mesh covers no pixel; nothing corresponds")
        return Correspondence(np.zeros((*inside.shape, 2), np.float32), inside, np.zeros_like(inside), size)
    visible, reference_visible = (
        _visible_vertices(s, m, facing) for s, m in ((surface, mesh), (reference_surface, reference_mesh))
    )
    masks = None if reference_mask is None else (mask if mask is not None else inside, reference_mask)
    reference = _Reference(reference_mesh, reference_visible, masks, size)
    places, valid = _interpolated(surface, visible, reference, np.arange(len(visible)))
    if pins is not None and len(pins.points):
        places = places + _pin_corrections(places, inside > 0, pins, pin_reach * mesh.interocular)
    if hidden == "input":
        return Correspondence(places, inside, valid, size)
    mirror = _mirror_vertices(mesh)
    if mirror is None:
        warn("warp.mesh: this mesh has no known mirror image; what the reference hides stays the input's")
        return Correspondence(places, inside, valid, size)
    needed = _extended(np.clip((_ENOUGH - valid) * 4, 0, 1) * inside, _FADE * mesh.interocular)
    mirrored, mirrored_valid = _interpolated(surface, visible, reference, mirror, needed)
    return Correspondence(places, inside, valid, size, mirrored, mirrored_valid * needed)


@dataclass(frozen=True)
class _Reference:
    """The reference's mesh, visibility of its vertices (V,), masks (the input's, its own) or None, and its size."""

    mesh: Mesh
    visible: FloatArray
    masks: tuple[Mask, Mask] | None
    size: tuple[int, int]


def _visible_vertices(surface: Surface, mesh: Mesh, facing: float) -> FloatArray:
    """How far the photo shows each vertex, (V,) 0 to 1: in the frame, not occluded, facing the viewer, off the outline.

    Surfaces near the outline do not count, because a small error of the fit would show the background there.
    """
    import cv2

    turned = np.clip((mesh.normals[:, 2] / facing - 0.5) * 2, 0, 1)
    covered = (surface.coverage[::2, ::2] > 0).astype(np.uint8)  # half the resolution is accurate enough
    row, column, _ = vertex_pixels(mesh, surface.coverage.shape)
    depth = 2 * cv2.distanceTransform(covered, cv2.DIST_L2, 3)[row // 2, column // 2]
    off_outline = np.clip(depth / max(_OUTLINE * mesh.interocular, 1e-6), 0, 1)
    return np.asarray(unoccluded(surface, mesh, _DEPTH_TOLERANCE) * turned * off_outline, np.float32)


def _interpolated(
    surface: Surface, visible: FloatArray, reference: _Reference, vertex: NDArray[Any], needed: Mask | None = None
) -> tuple[FloatArray, Mask]:
    """Places H x W x 2 in the reference, and their validity H x W.

    Args:
        visible: of the input's vertices. vertex: the reference's vertex that belongs to each of the input's.
        needed: where it is 0 the results are not needed, and are 0.
    """
    triangles, camera = reference.mesh.triangles, reference.mesh.camera
    valid_vertices = np.minimum((reference.visible[vertex] + _INVISIBLE) / (visible + _INVISIBLE), 1)
    of_vertex = np.column_stack([reference.mesh.vertices[vertex], valid_vertices]).astype(np.float32)
    of_corner = [of_vertex[triangles[:, k]] for k in range(3)]
    places = np.zeros((*surface.coverage.shape, 2), np.float32)
    valid = np.zeros(surface.coverage.shape, np.float32)
    box = bounding_box(surface.coverage > 0)
    assert box is not None, "the caller has seen to it that the mesh covers a pixel"
    triangle_at, weights = surface.triangle[box], surface.barycentric[box]
    wanted = triangle_at >= 0 if needed is None else (triangle_at >= 0) & (needed[box] > 0)
    height, width = reference.size

    def strip(rows: slice) -> None:
        row, column = np.nonzero(wanted[rows])
        triangle, weight = triangle_at[rows][row, column], weights[rows][row, column]
        found = np.zeros((len(triangle), 4), np.float32)
        for k, values in enumerate(of_corner):
            found += weight[:, k, None] * values.take(triangle, axis=0)
        # Barycentric coordinates are those of the point in space, so it is interpolated there, and then projected.
        at = camera.project(found[:, :3])
        x, y = at[:, 0], at[:, 1]
        in_frame = (x >= -0.5) & (y >= -0.5) & (x <= width - 0.5) & (y <= height - 0.5)
        pixels = row + box[0].start + rows.start, column + box[1].start
        places[pixels], valid[pixels] = at, found[:, 3] * in_frame

    by_strips(strip, (*triangle_at.shape, 4))
    if reference.masks is not None:
        own, of_reference = reference.masks[0], _sampled(reference.masks[1], places)
        valid *= np.minimum((of_reference + _INVISIBLE) / (own + _INVISIBLE), 1)
    return places, valid


def _sampled(values: FloatArray, places: FloatArray) -> FloatArray:
    import cv2

    return np.asarray(cv2.remap(values, places, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE), np.float32)  # type: ignore[call-overload]


def _extended(needed: Mask, sigma: float) -> Mask:
    """The mask, continued beyond its edge by a ramp that ends after about two sigmas."""
    if not needed.any():
        return needed
    extended: Mask = np.maximum(needed, np.clip(2 * blurred(needed, max(sigma, 0.5)), 0, 1))
    return extended


def _mirror_vertices(mesh: Mesh) -> NDArray[np.int32] | None:
    """The vertex that each becomes in a mirror: given with the mesh, or known for meshes of the 468 points.

    The vertices that `render.head` appends (skull, neck) are their own mirror images.
    """
    known, count = mesh.mirror, len(mesh.vertices)
    if known is None and count == len(facemesh_topology().mirror):
        known = facemesh_topology().mirror
    if known is None:
        return None
    return np.concatenate([known, np.arange(len(known), count, dtype=np.int32)])


def _pin_corrections(places: FloatArray, inside: NDArray[np.bool_], pins: Pins, sigma: float) -> FloatArray:
    """H x W x 2 to add to the places: each pin's correction under a Gaussian window, normalized where windows overlap.

    A pin beside the mesh, where there are no places, corrects that of the nearest pixel of the mesh, moved by as much.
    Shepard, A two-dimensional interpolation function for irregularly-spaced data, 1968, with Gaussian weights.
    """
    on_mesh = np.argwhere(inside)
    height, width = places.shape[:2]
    y, x = np.ogrid[:height, :width]
    total, weight = np.zeros_like(places), np.zeros((height, width), np.float32)
    for px, py, rx, ry in pins.points:
        row, column = (int(np.clip(round(float(p)), 0, n - 1)) for p, n in ((py, height), (px, width)))
        near = np.exp(-((x - px) ** 2 + (y - py) ** 2) / np.float32(2 * max(sigma, 1e-3) ** 2)).astype(np.float32)
        at, off = (row, column), np.zeros(2, np.float32)
        if not inside[at]:
            nearest = on_mesh[np.argmin(np.square(on_mesh - at).sum(axis=1))]
            at, off = (
                (nearest[0], nearest[1]),
                _step(places, inside, nearest) * np.subtract((column, row), nearest[::-1]),
            )
        total += near[..., None] * (np.array([rx, ry], np.float32) - places[at] - off)
        weight += near
    return np.asarray(total / np.maximum(weight, 1)[..., None], np.float32)


def _step(places: FloatArray, inside: NDArray[np.bool_], at: NDArray[Any], radius: int = 4) -> float:
    """Pixels of the reference per pixel of the input around a pixel of the mesh: the median, 1 where none is known."""
    around = tuple(slice(max(0, int(i) - radius), int(i) + radius + 2) for i in at)
    both = inside[around][1:, 1:] & inside[around][:-1, :-1]
    if not both.any():
        return 1.0
    steps = (places[around][1:, 1:] - places[around][:-1, :-1])[both]
    return float(np.median(np.hypot(steps[:, 0], steps[:, 1])) / np.sqrt(2))
