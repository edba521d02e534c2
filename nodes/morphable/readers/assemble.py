"""The last step of all readers: cut out the face, close its holes, convert it to the container's frame and unit."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile
from graphface.nodes.morphable.model import EYE_CORNERS, Basis, InvalidModel, MorphableModel
from graphface.nodes.types import FloatArray

_MIN_LOOP = 3
"""Least number of edges of a hole."""


def assemble(
    source: Path,
    name: str,
    mean: NDArray[np.floating[Any]],
    triangles: NDArray[np.integer[Any]],
    identity: NDArray[np.floating[Any]],
    expression: NDArray[np.floating[Any]],
    landmarks68: NDArray[np.integer[Any]],
    *,
    expression_names: Sequence[str] = (),
    uv: FloatArray | None = None,
    parts: NDArray[np.int32] | None = None,
    part_names: Sequence[str] = (),
    card: Mapping[str, Any],
) -> MorphableModel:
    """A model from arrays in the source's own units and axes (x to the picture's right, y up, z out of the face).

    Args:
        triangles: those of the face; vertices that none of them uses are dropped.
        identity, expression: (K, V, 3), displacement for one standard deviation.
        landmarks68: (68,) vertices, -1 where the source has no such point.

    Raises:
        UnreadableFile: the parts do not agree, or the outer eye corners are not among the landmarks.
    """
    if min(landmarks68[list(EYE_CORNERS["ibug68"])]) < 0:
        raise UnreadableFile(source, "its landmarks lack the outer eye corners (ibug 37 and 46), which give the unit")
    used = np.union1d(triangles.ravel(), landmarks68[landmarks68 >= 0])
    number = np.full(len(mean), -1, np.int64)
    number[used] = np.arange(len(used))
    kept, holes = closed(number[triangles], boundary_loops(number[triangles])[1:], len(used))
    landmarks = np.where(landmarks68 >= 0, number[landmarks68], -1).astype(np.int32)
    vertices, unit = _in_frame(source, np.asarray(mean, np.float64)[used], landmarks)
    basis = np.concatenate([identity, expression]).astype(np.float32)
    directions = _with_centers(basis[:, used] / unit, holes, axis=1).astype(np.float32)
    split = len(identity)
    names = tuple(expression_names) or tuple(f"expression {k}" for k in range(len(expression)))
    try:
        return MorphableModel(
            name=name,
            mean=_with_centers(vertices, holes).astype(np.float32),
            triangles=kept.astype(np.int32),
            identity=_basis(directions[:split], tuple(f"identity {k}" for k in range(split)), unit),
            expression=_basis(directions[split:], names, unit),
            landmarks={"ibug68": landmarks},
            uv=None if uv is None else _with_centers(np.asarray(uv, np.float32)[used], holes),
            parts=None if parts is None else _parts(parts[used], holes),
            part_names=tuple(part_names),
            card=dict(card),
        )
    except InvalidModel as error:
        raise UnreadableFile(source, error.reason) from error


def _in_frame(
    source: Path, vertices: NDArray[np.float64], landmarks: NDArray[np.int32]
) -> tuple[NDArray[np.float64], float]:
    """Vertices in the container's frame and unit, and that unit in the source's."""
    first, second = (vertices[landmarks[k]] for k in EYE_CORNERS["ibug68"])
    unit = float(np.linalg.norm(first - second))
    if not unit > 0:
        raise UnreadableFile(source, "its outer eye corners coincide")
    inner = landmarks[17:][landmarks[17:] >= 0]
    return (vertices - vertices[inner].mean(axis=0)) / unit, unit


def with_facemesh_points(model: MorphableModel) -> MorphableModel:
    """The model with the 468 FaceMesh points found on it, so that it can be fitted to all of them."""
    from graphface.nodes.morphable.readers.correspond import facemesh_on

    return replace(model, landmarks={**model.landmarks, "facemesh468": facemesh_on(model)})


def boundary_loops(triangles: NDArray[np.integer[Any]]) -> list[list[int]]:
    """Closed lines of edges that belong to a single triangle, longest first, in the triangles' direction."""
    directed = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    pairs = {(int(a), int(b)) for a, b in directed}
    following = defaultdict(list)
    for a, b in pairs:
        if (b, a) not in pairs:
            following[a].append(b)
    loops = []
    while following:
        start = next(iter(following))
        loop, here = [], start
        while here in following:
            loop.append(here)
            nexts = following[here]
            step = nexts.pop()
            if not nexts:
                del following[here]
            here = step
        if here == start and len(loop) >= _MIN_LOOP:
            loops.append(loop)
    return sorted(loops, key=len, reverse=True)


def closed(
    triangles: NDArray[np.integer[Any]], loops: list[list[int]], vertices: int
) -> tuple[NDArray[np.int64], list[list[int]]]:
    """Each loop closed by a fan around a new vertex, numbered from `vertices`: the triangles, and the loops."""
    fans = []
    for number, loop in enumerate(loops):
        center = vertices + number
        fans += [(b, a, center) for a, b in zip(loop, loop[1:] + loop[:1], strict=True)]
    extra = np.array(fans, np.int64).reshape(-1, 3)
    return np.concatenate([triangles.astype(np.int64), extra]), loops


def _with_centers(values: NDArray[Any], loops: list[list[int]], axis: int = 0) -> NDArray[Any]:
    """The values of the vertices, and the mean along each loop: linear, so it serves mean and directions alike."""
    if not loops:
        return values
    centers = np.stack([values.take(loop, axis=axis).mean(axis=axis) for loop in loops], axis=axis)
    return np.concatenate([values, centers], axis=axis)


def _parts(parts: NDArray[np.int32], loops: list[list[int]]) -> NDArray[np.int32]:
    """The part of each vertex; the center of a loop has that of the loop's first vertex."""
    return np.concatenate([parts, [parts[loop[0]] for loop in loops]]).astype(np.int32)


def _basis(directions: FloatArray, names: tuple[str, ...], unit: float) -> Basis:
    return Basis(directions, np.full(len(directions), unit, np.float32), names)
