"""Correspondence through two aligned meshes (paper, "Face geometry"): the same triangle, the same weights."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import UsageError, node, warn
from graphface.nodes.blur import blurred
from graphface.nodes.morphable.topology import facemesh_topology
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Correspondence, FloatArray, Mask, Mesh, Pins, Surface

Hidden = Literal["mirror", "input"]


_UNSEEN = 0.05
"""What counts as not seen at all, 0..1: two photos that both do not show a point are equally good."""


_STANDS_IN = 0.7
"""How far the reference must show a point for its mirror image not to be asked."""


_FADE = 0.04
"""Width of the way from a point to its mirror image, inter-ocular distances, on the side where the point is shown: on
the other side the reference may be anything."""


_OUTLINE = 0.06
"""Distance from the mesh's outline, inter-ocular distances, below which a place may show what is behind the face."""


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

    Args:
        surface, mesh: the input's. reference_surface, reference_mesh: the reference's, of the same triangles.
        mask, reference_mask: the input's skin, and what of the reference may be taken, its skin; without them, all. A
            place is valid where the reference shows the point as well as the input does.
        pins: correspondences set by hand; their corrections fade out over `pin_reach` inter-ocular distances.
        hidden: what stands in for points that the reference hides: their mirror images, or nothing (the input stays).
        facing: cosine between normal and view at which the reference fully shows a surface; at half of it, not at all.

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
        places = np.zeros((*inside.shape, 2), np.float32)
        return Correspondence(places, inside, np.zeros_like(inside), size)

    own, shown = (_shown_vertices(s, m, facing) for s, m in ((surface, mesh), (reference_surface, reference_mesh)))
    masks = None if reference_mask is None else (mask if mask is not None else inside, reference_mask)
    places, valid = _carried(surface, reference_mesh, own, shown, np.arange(len(own)), masks, size)
    if pins is not None and len(pins.points):
        places = places + _pinned(places, pins, pin_reach * mesh.interocular)
    mirror = _mirror_vertices(mesh)
    if hidden == "input" or mirror is None:
        if hidden == "mirror":
            warn("warp.mesh: this mesh has no known mirror image; what the reference hides stays the input's")
        return Correspondence(places, inside, valid, size)
    needed = _spread(np.clip((_STANDS_IN - valid) * 4, 0, 1) * inside, _FADE * mesh.interocular)
    mirrored, mirrored_valid = _carried(surface, reference_mesh, own, shown, mirror, masks, size, needed)
    mirrored_valid *= needed
    return Correspondence(places, inside, valid, size, mirrored, mirrored_valid)


def _spread(needed: Mask, width: float) -> Mask:
    """Grown, and fading out from where it ended."""
    if not needed.any():
        return needed
    wider: Mask = np.maximum(needed, np.clip(2 * blurred(needed, max(width, 0.5)), 0, 1))
    return wider


def _shown_vertices(surface: Surface, mesh: Mesh, facing: float) -> NDArray[np.float64]:
    """How far the photo shows each vertex, 0..1: inside the frame and the outline, turned here, nothing in front."""
    import cv2

    height, width = surface.coverage.shape
    pixels = mesh.camera.project(mesh.vertices.astype(np.float64))
    in_frame = ((pixels >= -0.5) & (pixels <= np.array([width, height]) - 0.5)).all(axis=1)
    x, y = (np.clip(np.rint(pixels[:, k]), 0, n - 1).astype(int) for k, n in ((0, width), (1, height)))
    behind = np.where(surface.coverage[y, x] > 0, surface.depth[y, x] - mesh.vertices[:, 2], 0)
    unoccluded = np.clip(2 - behind / max(0.12 * mesh.interocular, 1e-6), 0, 1)
    turned = np.clip((mesh.normals[:, 2] / facing - 0.5) * 2, 0, 1)
    sparse = (surface.coverage[::2, ::2] > 0).astype(np.uint8)  # every other pixel tells it well enough
    depth = 2 * cv2.distanceTransform(sparse, cv2.DIST_L2, 3)[y // 2, x // 2]
    within = np.clip(depth / max(_OUTLINE * mesh.interocular, 1e-6), 0, 1)
    shown: NDArray[np.float64] = in_frame * unoccluded * turned * within
    return shown


def _carried(
    surface: Surface,
    reference: Mesh,
    own: NDArray[np.float64],
    shown: NDArray[np.float64],
    vertex: NDArray[Any],
    masks: tuple[Mask, Mask] | None,
    size: tuple[int, int],
    needed: Mask | None = None,
) -> tuple[FloatArray, Mask]:
    """Places H x W x 2 and validity H x W, where vertex k of the input's mesh is vertex[k] of the reference's.

    `needed`: where it is 0 the answer is of no use, and is 0.
    """
    positions = reference.vertices[vertex]
    valid_at = np.minimum((shown[vertex] + _UNSEEN) / (own + _UNSEEN), 1)
    of_vertex = np.column_stack([positions, valid_at]).astype(np.float32)
    triangles = reference.triangles
    rows, columns = _window(surface.coverage > 0)
    seen, weights = surface.triangle[rows, columns], surface.barycentric[rows, columns]
    wanted = seen >= 0 if needed is None else (seen >= 0) & (needed[rows, columns] > 0)
    tables = [of_vertex[triangles[:, k]] for k in range(3)]
    places = np.zeros((*surface.coverage.shape, 2), np.float32)
    valid = np.zeros(surface.coverage.shape, np.float32)
    height, width = size

    def carry(strip: slice) -> None:
        row, column = np.nonzero(wanted[strip])
        triangle, weight = seen[strip][row, column], weights[strip][row, column]
        carried = np.zeros((len(triangle), 4), np.float32)
        for k, table in enumerate(tables):
            carried += weight[:, k, None] * table.take(triangle, axis=0)
        # The weights are those of the point in space, so it is points in space that they may mix.
        at = reference.camera.project(carried[:, :3])
        x, y = at[:, 0], at[:, 1]
        inside = (x >= -0.5) & (y >= -0.5) & (x <= width - 0.5) & (y <= height - 0.5)
        pixels = row + rows.start + strip.start, column + columns.start
        places[pixels], valid[pixels] = at, carried[:, 3] * inside

    by_strips(carry, (*seen.shape, 4))
    if masks is not None:
        unseen = np.float32(_UNSEEN)
        valid *= np.minimum((_sampled(masks[1], places) + unseen) / (masks[0] + unseen), 1)
    return places, valid


def _sampled(values: FloatArray, places: FloatArray) -> FloatArray:
    import cv2

    return np.asarray(cv2.remap(values, places, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE), np.float32)  # type: ignore[call-overload]


def _window(covered: NDArray[np.bool_]) -> tuple[slice, slice]:
    """The bounding box of what is covered."""
    rows, columns = np.flatnonzero(covered.any(axis=1)), np.flatnonzero(covered.any(axis=0))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


def _mirror_vertices(mesh: Mesh) -> NDArray[np.int32] | None:
    """Which vertex each becomes in a mirror, for models that tell and for the meshes over the 468 points.

    The vertices that `render.head` puts at the end (skull, neck) stand in for none but themselves.
    """
    known, count = mesh.mirror, len(mesh.vertices)
    if known is None and count == len(facemesh_topology().mirror):
        known = facemesh_topology().mirror
    if known is None:
        return None
    return np.concatenate([known, np.arange(len(known), count, dtype=np.int32)])


def _pinned(places: FloatArray, pins: Pins, reach: float) -> FloatArray:
    """Corrections H x W x 2 that take every pin where it should be, Gaussian around it (Shepard's weights)."""
    height, width = places.shape[:2]
    y, x = np.ogrid[:height, :width]
    total, weight = np.zeros_like(places), np.zeros((height, width), np.float32)
    for px, py, rx, ry in pins.points:
        at = places[int(np.clip(round(float(py)), 0, height - 1)), int(np.clip(round(float(px)), 0, width - 1))]
        near = np.exp(-((x - px) ** 2 + (y - py) ** 2) / np.float32(2 * max(reach, 1e-3) ** 2)).astype(np.float32)
        total += near[..., None] * (np.array([rx, ry], np.float32) - at)
        weight += near
    return np.asarray(total / np.maximum(weight, 1)[..., None], np.float32)
