"""How near each geometry comes to the path-traced heads: landmarks, normals, depth, and the time it takes.

The landmarks come from the photo under each light, as they would in use: what the light does to the network is part of
the answer. A model made from the data that the heads were made from is flattered; the table says which model it is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import Graph
from graphface.nodes.bench.geometry_graphs import geometry_graph, model_graph
from graphface.nodes.bench.heads import LIGHTS, Head, heads_of
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.landmark_schemes import IBUG68_IN_FACEMESH468
from graphface.nodes.metrics import normal_angle
from graphface.nodes.morphable.model import EYE_CORNERS, MorphableModel
from graphface.nodes.types import Mesh

_FAR = 1e3
"""Depths beyond this, in centimetres, are background."""


@dataclass(frozen=True)
class Geometry:
    """A representation with this geometry, its further `inputs`, and the vertices at the 68 points (-1: none)."""

    name: str
    graph: Graph
    inputs: Mapping[str, Any]
    points68: NDArray[np.integer[Any]]


@dataclass(frozen=True)
class Accuracy:
    """One geometry on one head under one light.

    `landmarks` mean distance from the true 68 points in per cent of the distance between the outer eye corners, None
    where the head has no such points; `normals` mean angle in degrees over the face label; `depth` correlation with the
    true depth; `milliseconds` of CPU for the mesh once the landmarks are there.
    """

    geometry: str
    head: str
    light: str
    landmarks: float | None
    normals: float
    depth: float
    milliseconds: float


def geometries(models: Mapping[str, MorphableModel]) -> list[Geometry]:
    """FaceMesh itself; then, for each model, the fit and the average face."""
    found = [Geometry("facemesh", geometry_graph("geometry.facemesh"), {}, IBUG68_IN_FACEMESH468)]
    for name, model in models.items():
        for method in ("morphable", "average"):
            graph = model_graph(f"geometry.{method}")
            found.append(Geometry(f"{method}, {name}", graph, {"model": model}, model.landmarks["ibug68"]))
    return found


def geometry_truth(data: Path, models: Mapping[str, MorphableModel]) -> Iterator[Accuracy]:
    """Every geometry on every head under every light.

    Args:
        data: the folder that holds `truth`.
        models: name to model.

    Raises:
        UnreadableFile: there are no heads at `data`.
    """
    heads = heads_of(data)
    compared = geometries(models)
    for head in heads:
        yield from _head(head, compared)


def _head(head: Head, compared: Sequence[Geometry]) -> Iterator[Accuracy]:
    evaluator = MeteredEvaluator()
    for light in LIGHTS:
        for geometry in compared:
            graph, asked = geometry.graph, ("landmarks", "mesh", "surface")
            found = graph.run(asked, evaluator=evaluator, photo=head.path(light), **geometry.inputs)
            surface = found["surface"]
            both = (surface.coverage > 0) & (head.face > 0) & (head.depth > 0) & (head.depth < _FAR)
            points = head.points68
            yield Accuracy(
                geometry=geometry.name,
                head=head.name,
                light=light,
                landmarks=None if points is None else landmark_error(found["mesh"], geometry.points68, points),
                normals=normal_angle(surface.normals, head.normals, head.face),
                depth=correlation(surface.depth[both], -head.depth[both]),
                milliseconds=evaluator.cpu_ms(evaluator.key("mesh"), [evaluator.key("landmarks")]),
            )


def landmark_error(
    mesh: Mesh, vertices: NDArray[np.integer[Any]], points: NDArray[np.floating[Any]], over: float | None = None
) -> float:
    """Mean distance in per cent between projected vertices and true points (68, 2) or more columns.

    Args:
        vertices: (68,), -1 where the mesh has no such point; those do not count.
        over: the length that distances are relative to; by default that between the true outer eye corners.
    """
    known = vertices >= 0
    projected = mesh.camera.project(mesh.vertices[vertices[known]].astype(np.float64))
    right, left = EYE_CORNERS["ibug68"]
    unit = over if over is not None else float(np.linalg.norm(points[right, :2] - points[left, :2]))
    return float(100 * np.linalg.norm(projected - points[known, :2], axis=1).mean() / max(unit, 1e-6))


def correlation(a: NDArray[np.floating[Any]], b: NDArray[np.floating[Any]]) -> float:
    """Pearson's; 0 where one of the two does not vary."""
    if a.size < 2:
        return 0.0
    a, b = a.astype(np.float64) - a.mean(dtype=np.float64), b.astype(np.float64) - b.mean(dtype=np.float64)
    return float(a @ b / max(float(np.sqrt((a @ a) * (b @ b))), 1e-12))
