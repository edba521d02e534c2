"""The model of `render.fitted_head`: ICT-FaceKit's head with ears, neck and shoulders, on fewer triangles.

`graphface models head ict_facekit.npz --data DATA` made `nodes/morphable/head.safetensors`. Of ICT-FaceKit it takes the
skin, closes mouth and neck, adds the part of the eyeballs that shows between the lids, and keeps the first identities.
Vertices without triangles at the end are the 468 points of FaceMesh, so that they are fitted where they really lie.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.learning.decimation import decimated
from graphface.nodes.learning.head_points import facemesh_on_head
from graphface.nodes.morphable.model import Basis, MorphableModel, no_basis
from graphface.nodes.morphable.readers.assemble import boundary_loops, closed
from graphface.nodes.morphable.readers.ict import IctHead, read_head, triangles_of

_SKIN = 11144
"""Polygons of face, head and neck, first in the list (ICT-FaceKit's README)."""


_EYEBALLS = slice(21451, 24591)
"""Vertices of both eyeballs."""


_EYE_REACH = 1.15
"""Radius of the part of an eyeball that is kept, as a share of the largest distance of a lid's edge."""


_BEHIND_EYE = 0.6
"""Centimetres by which the surface that closes the lids lies behind their edge: the eyeball is in front of it."""


_DETAIL_REACH, _LEAST_DETAIL = 1.5, 0.1
"""Centimetres about FaceMesh's points within which errors count fully, and their weight elsewhere."""


_CARD = {
    "doc": "A head with ears, neck and shoulders for render.fitted_head; the last 468 vertices are FaceMesh's points.",
    "license": "MIT; see LICENSE.ICT-FaceKit beside this file",
    "source": "ICT-FaceKit, USC Institute for Creative Technologies, reduced",
    "learned_from": "FaceMesh's points lie where the network finds them on path-traced heads made from ICT-FaceKit.",
    "limits": "No expressions: the smooth displacement takes them up. Ears are wider than real ones on some people.",
    "command": "graphface models head ict_facekit.npz --data DATA",
}


def head_model(source: Path, data: Path, *, identity: int, triangles: int) -> MorphableModel:
    """The model from ICT-FaceKit (its folder or a packed .npz).

    Args:
        data: the folder that holds `truth`, heads made from ICT-FaceKit.
        identity: number of identities, of which the first vary most. triangles: approximate number.

    Raises:
        UnreadableFile: a source is missing or damaged.
    """
    head = read_head(source)
    surface = _Surface(head)
    points = facemesh_on_head(head, surface.of, surface.triangles, data)
    importance = _importance(surface.mean, points.at(surface.mean, surface.triangles))
    kept = decimated(surface.mean, surface.triangles, importance, triangles)
    used, numbers = np.unique(kept, return_inverse=True)
    unit = float(np.linalg.norm(head.mean[head.landmarks[36]] - head.mean[head.landmarks[45]]))

    def with_points(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.concatenate([values[used], points.at(values, surface.triangles)]) / unit

    mean = with_points(surface.mean)
    shapes = np.stack([with_points(surface.of(shape)) for shape in head.identity[:identity]]).astype(np.float32)
    return MorphableModel(
        name="head",
        mean=(mean - mean[len(used) :].mean(axis=0)).astype(np.float32),
        triangles=numbers.reshape(-1, 3).astype(np.int32),
        identity=Basis(shapes, np.full(identity, unit, np.float32), tuple(f"identity {k}" for k in range(identity))),
        expression=no_basis(len(mean)),
        landmarks={"facemesh468": np.arange(len(used), len(mean), dtype=np.int32)},
        card=dict(_CARD),
    )


class _Surface:
    """The skin with its holes closed, and the eyeballs between the lids.

    `triangles` (T, 3) are numbered among its own vertices, to which `of` takes values at the whole head's.
    """

    def __init__(self, head: IctHead) -> None:
        skin = triangles_of(head.polygons[:_SKIN])
        self._count = int(skin.max()) + 1
        closed_skin, self._loops = closed(skin, boundary_loops(skin), self._count)
        self._eyes, eye_triangles = _eyeballs(head, self._loops)
        self.triangles = np.concatenate([closed_skin, eye_triangles + self._count + len(self._loops)])
        self.mean = self.of(head.mean)
        for k, loop in enumerate(self._loops):
            if _is_eye(head.mean[loop]):
                self.mean[self._count + k, 2] -= _BEHIND_EYE

    def of(self, values: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
        """(V, 3) to the surface's vertices: those of the skin, the middle of each loop, those of the eyeballs."""
        middles = [values[loop].mean(axis=0, dtype=np.float64)[None] for loop in self._loops]
        return np.concatenate([values[: self._count], *middles, values[self._eyes]]).astype(np.float64)


def _is_eye(loop: NDArray[np.float32]) -> bool:
    """Mouth and neck lie on the midline, eyes do not."""
    return abs(float(loop[:, 0].mean())) > 1


def _eyeballs(head: IctHead, loops: list[list[int]]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The vertices of what shows of the eyeballs, and triangles numbered among them."""
    triangles = triangles_of(head.polygons)
    eyeballs = triangles[((triangles >= _EYEBALLS.start) & (triangles < _EYEBALLS.stop)).all(axis=1)]
    a, b, c = (head.mean[eyeballs[:, k]] for k in range(3))
    near = np.zeros(len(eyeballs), bool)
    for loop in loops:
        edge = head.mean[loop]
        if _is_eye(edge):
            middle = edge.mean(axis=0)
            reach = _EYE_REACH * np.linalg.norm((edge - middle)[:, :2], axis=1).max()
            near |= np.linalg.norm(((a + b + c) / 3 - middle)[:, :2], axis=1) < reach
    kept = eyeballs[near & (np.cross(b - a, c - a)[:, 2] > 0)]
    vertices, numbers = np.unique(kept, return_inverse=True)
    return vertices, numbers.reshape(-1, 3)


def _importance(mean: NDArray[np.float64], facemesh: NDArray[np.float64]) -> NDArray[np.float64]:
    """The weight of errors at each vertex: the face needs more detail than the back of the head."""
    from scipy.spatial import cKDTree

    distance = cKDTree(facemesh).query(mean)[0]
    weight: NDArray[np.float64] = _LEAST_DETAIL + np.exp(-np.square(distance / _DETAIL_REACH))
    return weight
