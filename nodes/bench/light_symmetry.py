"""How alike the two sides of photographed faces are once the estimated light is taken out.

Nobody knows the true light of a photograph. But the skin of both cheeks is the same, so what differs between mirrored
points after the picture was divided by its estimated shading is light that was not found.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import Evaluator, GraphfaceError, MemoryTier, load, warn
from graphface.nodes.bench.known_lights import Variant
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean
from graphface.nodes.types import FloatArray, Mesh

_OUTPUTS = ("face.working", "face.estimated", "face.mesh")

_BLUR = 0.06
"""Standard deviation, in inter-ocular distances: larger than moles and strands."""

_FACING = 0.35
"""Cosine between normal and view direction from which a vertex is looked at."""

_FEWEST = 40
"""Pairs of vertices that both are seen; a face in profile has fewer."""

_LEAST_BRIGHTNESS, _LEAST_SHADING = np.float32(0.02), np.float32(0.05)


@dataclass(frozen=True)
class SideFigure:
    """Differences of logarithms between mirrored points, of the photo and of the photo over its estimated shading.

    `side`: the absolute median, how much brighter one side is; `points`: the root mean square.
    """

    variant: str
    photo: str
    side_before: float
    side_after: float
    points_before: float
    points_after: float


def light_symmetry(photos: Iterable[Path], variants: Sequence[Variant]) -> Iterator[SideFigure]:
    """Every variant of the relight graph on every photo with a face that shows both sides."""
    graphs = {v.name: load("relight", replace=v.replace, set=v.set) for v in variants}
    for path in photos:
        evaluator = Evaluator(memory=MemoryTier())
        for name, graph in graphs.items():
            try:
                photo, shading, mesh = graph.run(_OUTPUTS, evaluator=evaluator, photo=path).values()
            except GraphfaceError as error:
                warn(f"{path.name} is left out: {error}")
                break
            compared = _sides(channel_mean(photo.pixels), channel_mean(shading), mesh)
            if compared is None:
                warn(f"{path.name} is left out: the face hardly shows both sides")
                break
            yield SideFigure(name, path.name, *compared)


def _sides(brightness: FloatArray, shading: FloatArray, mesh: Mesh) -> tuple[float, float, float, float] | None:
    rows, columns, pairs = _pairs(mesh, brightness.shape)
    if len(pairs) < _FEWEST:
        return None
    sigma = max(_BLUR * mesh.interocular, 0.5)
    own = np.log(np.maximum(blurred(brightness, sigma), _LEAST_BRIGHTNESS))[rows, columns]
    light = np.log(np.maximum(blurred(shading, sigma), _LEAST_SHADING))[rows, columns]
    left, right = pairs.T
    before, after = own[left] - own[right], (own - light)[left] - (own - light)[right]
    sides = (abs(float(np.median(before))), abs(float(np.median(after))))
    return *sides, float(np.sqrt(np.square(before).mean())), float(np.sqrt(np.square(after).mean()))


def _pairs(mesh: Mesh, shape: tuple[int, ...]) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
    """The pixel of each vertex, within the picture, and the pairs (n, 2) of mirrored vertices that both are seen."""
    place = np.round(mesh.camera.project(mesh.vertices)[:, :2]).astype(np.intp)
    columns, rows = (np.clip(place[:, k], 0, shape[1 - k] - 1) for k in (0, 1))
    if mesh.mirror is None:
        return rows, columns, np.zeros((0, 2), np.intp)
    seen = (rows == place[:, 1]) & (columns == place[:, 0]) & (mesh.normals[:, 2] > _FACING)
    vertices = np.arange(len(place))
    kept = seen & seen[mesh.mirror] & (mesh.mirror > vertices)
    return rows, columns, np.stack([vertices[kept], mesh.mirror[kept]], axis=1).astype(np.intp)
