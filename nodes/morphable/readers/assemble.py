"""What all readers end with: cut out the face, close its holes, bring it into the container's frame and unit."""

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

_LEAST_LOOP = 3


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
    corners = [int(landmarks68[k]) for k in EYE_CORNERS["ibug68"]]
    if min(corners) < 0:
        raise UnreadableFile(source, "its landmarks lack the outer eye corners (ibug 37 and 46), which give the unit")
    basis = np.concatenate([identity, expression]).astype(np.float32)
    used = np.union1d(triangles.ravel(), landmarks68[landmarks68 >= 0])
    number = np.full(len(mean), -1, np.int64)
    number[used] = np.arange(len(used))
    kept = number[triangles]
    corners = [int(number[c]) for c in corners]
    places, moves = np.asarray(mean, np.float64)[used], basis[:, used]
    loops = boundary_loops(kept)
    kept, fans = closed(kept, loops[1:], len(used))
    unit = float(np.linalg.norm(places[corners[0]] - places[corners[1]]))
    if not unit > 0:
        raise UnreadableFile(source, "its outer eye corners coincide")
    of_source = np.where(landmarks68 >= 0, number[landmarks68], -1).astype(np.int32)
    inner = of_source[17:][of_source[17:] >= 0]
    middle = places[inner].mean(axis=0)
    places = _with_middles((places - middle) / unit, fans)
    moves = _with_middles(moves / unit, fans, axis=1).astype(np.float32)
    split = len(identity)
    names = tuple(expression_names) or tuple(f"expression {k}" for k in range(len(expression)))
    try:
        return MorphableModel(
            name=name,
            mean=places.astype(np.float32),
            triangles=kept.astype(np.int32),
            identity=_basis(moves[:split], tuple(f"identity {k}" for k in range(split)), unit),
            expression=_basis(moves[split:], names, unit),
            landmarks={"ibug68": of_source},
            uv=None if uv is None else _with_middles(np.asarray(uv, np.float32)[used], fans),
            parts=None
            if parts is None
            else np.concatenate([parts[used], [parts[used][f[0]] for f in fans]]).astype(np.int32),
            part_names=tuple(part_names),
            card=dict(card),
        )
    except InvalidModel as error:
        raise UnreadableFile(source, error.reason) from error


def with_facemesh_points(model: MorphableModel) -> MorphableModel:
    """The model with the 468 FaceMesh points found on it, so that it can be fitted to all of them."""
    from graphface.nodes.morphable.readers.correspond import facemesh_on

    return replace(model, landmarks={**model.landmarks, "facemesh468": facemesh_on(model)})


def boundary_loops(triangles: NDArray[np.integer[Any]]) -> list[list[int]]:
    """The closed lines of edges that have one triangle only, longest first, in the triangles' direction."""
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
        if here == start and len(loop) >= _LEAST_LOOP:
            loops.append(loop)
    return sorted(loops, key=len, reverse=True)


def closed(
    triangles: NDArray[np.integer[Any]], loops: list[list[int]], vertices: int
) -> tuple[NDArray[np.int64], list[list[int]]]:
    """Close each loop by a fan about a new vertex (numbered from `vertices`); the triangles, and the loops closed."""
    fans = []
    for number, loop in enumerate(loops):
        middle = vertices + number
        fans += [(b, a, middle) for a, b in zip(loop, loop[1:] + loop[:1], strict=True)]
    extra = np.array(fans, np.int64).reshape(-1, 3)
    return np.concatenate([triangles.astype(np.int64), extra]), loops


def _with_middles(values: NDArray[Any], loops: list[list[int]], axis: int = 0) -> NDArray[Any]:
    """The values of the vertices, and of each loop's middle: linear, so it serves mean and directions alike."""
    if not loops:
        return values
    middles = np.stack([values.take(loop, axis=axis).mean(axis=axis) for loop in loops], axis=axis)
    return np.concatenate([values, middles], axis=axis)


def _basis(directions: FloatArray, names: tuple[str, ...], unit: float) -> Basis:
    return Basis(directions, np.full(len(directions), unit, np.float32), names)
