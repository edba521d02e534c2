"""ICT-FaceKit's whole head: face, ears, neck and skull, eyes, teeth and the cavities behind them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile
from graphface.nodes.morphable.readers.ict import IctHead, triangles_of
from graphface.nodes.morphable.readers.ict import read_head as read_ict
from graphface.nodes.morphable.subdivide import loop

SKIN, EYE, TEETH, GUMS, CAVITY = range(5)
"""What a vertex belongs to."""


_PARTS = (
    (slice(0, 11144), SKIN),
    (slice(11144, 14034), CAVITY),
    (slice(14034, 17006), GUMS),
    (slice(17006, 21496), TEETH),
    (slice(21496, 24692), EYE),
)
"""Polygons of the parts that are rendered (ICT-FaceKit's README). Lashes and the fluids of the eye, which follow, are
transparent sheets and are left out."""


_SMOOTH = {SKIN, CAVITY}
"""Parts that are subdivided once, so that relief of a millimetre can stand on them."""


@dataclass(frozen=True)
class HeadModel:
    """A linear model of a head: N coarse vertices, M refined ones; centimetres, x right, y up, z out of the face.

    Attributes:
        mean: float64 (N, 3). identity: float32 (I, N, 3). expression: float32 (E, N, 3), for weights 0 to 1.
        names: of the expressions.
        refinement: sparse (M, N), from coarse vertices to those that are rendered.
        triangles: int32 (T, 3), of the refined vertices.
        part: int8 (M,), SKIN, EYE, TEETH, GUMS or CAVITY.
        landmarks: int64 (68,), coarse vertices of the iBUG points.
    """

    mean: NDArray[np.float64]
    identity: NDArray[np.float32]
    expression: NDArray[np.float32]
    names: tuple[str, ...]
    refinement: Any
    triangles: NDArray[np.int32]
    part: NDArray[np.int8]
    landmarks: NDArray[np.int64]


def read_head(source: Path) -> HeadModel:
    """The head of ICT-FaceKit: the makers' folder, or a packed .npz.

    Raises:
        UnreadableFile: files are missing, do not agree, or are not those of the whole head.
    """
    head = read_ict(source)
    if len(head.polygons) < _PARTS[-1][0].stop:
        raise UnreadableFile(source, f"holds {len(head.polygons)} polygons, not the whole head of ICT-FaceKit")
    return _assembled(head)


def _assembled(head: IctHead) -> HeadModel:
    from scipy.sparse import csr_array, vstack

    count = len(head.mean)
    part = np.full(count, -1, np.int8)
    fine: list[NDArray[np.int64]] = []
    coarse: list[NDArray[np.int64]] = []
    for polygons, kind in _PARTS:
        triangles = triangles_of(head.polygons[polygons])
        own = np.unique(triangles)
        part[own[part[own] < 0]] = kind  # an edge belongs to the skin, not to the cavity behind it
        (fine if kind in _SMOOTH else coarse).append(triangles)
    smooth_triangles = np.concatenate(fine).astype(np.int32)
    matrix, refined = loop(smooth_triangles, count)
    kinds = np.concatenate([part, _kinds_of_edges(matrix[count:], part)])
    used, flat = np.unique(np.concatenate([refined, *coarse]), return_inverse=True)
    # Loop's rule also moves vertices without a smooth triangle: those keep their places.
    keep = csr_array((np.ones(count), (np.arange(count), np.arange(count))), shape=(count, count))
    smooth = np.zeros(count, bool)
    smooth[np.unique(smooth_triangles)] = True
    select = csr_array((smooth.astype(float), (np.arange(count), np.arange(count))), shape=(count, count))
    first = select @ matrix[:count] + (keep - select)
    return HeadModel(
        mean=head.mean.astype(np.float64),
        identity=head.identity,
        expression=head.expression,
        names=head.names,
        refinement=csr_array(vstack([first, matrix[count:]]))[used],
        triangles=flat.reshape(-1, 3).astype(np.int32),
        part=kinds[used],
        landmarks=head.landmarks.astype(np.int64),
    )


def _kinds_of_edges(rows: Any, part: NDArray[np.int8]) -> NDArray[np.int8]:
    """The part of each new vertex: that of the coarse vertex with the largest share in it; skin wins a tie."""
    dense = rows.tocoo()
    shares = np.zeros((rows.shape[0], CAVITY + 1))
    np.add.at(shares, (dense.coords[0], np.maximum(part[dense.coords[1]], 0)), dense.data)
    return np.asarray(np.argmax(shares, axis=1), np.int8)


def normals_of(vertices: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    """Unit normals (M, 3), means of the adjoining triangles' weighted by area: quicker than by angle."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    flat = np.cross(b - a, c - a)
    corners = triangles.ravel()
    sums = [np.bincount(corners, np.repeat(flat[:, axis], 3), len(vertices)) for axis in range(3)]
    normals = np.stack(sums, axis=1)
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12))
