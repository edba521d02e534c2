"""How near each geometry comes to the path-traced heads: landmarks, normals, depth, and the time it takes.

The landmarks come from the photo under each light, as they would in use: what the light does to the network is part of
the answer. A model made from the data that the heads were made from is flattered; the table says which model it is.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.commands.heads import LIGHTS, heads_of
from graphface.nodes.geometry.average import average
from graphface.nodes.geometry.facemesh import facemesh
from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.io.image_read import read_image
from graphface.nodes.landmark_schemes import IBUG68_IN_FACEMESH468
from graphface.nodes.landmarks.facemesh import facemesh as find_landmarks
from graphface.nodes.metrics import normal_angle
from graphface.nodes.morphable.model import EYE_CORNERS, MorphableModel
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Landmarks, Mesh

_FAR = 1e3
"""Depths beyond this, in centimetres, are background."""

_TIMED = 3
"""Runs of which the fastest counts: other work on the machine is not the method's."""


@dataclass(frozen=True)
class Geometry:
    """A way to a mesh, and the mesh's vertices at the 68 points (-1: it has none)."""

    name: str
    build: Callable[[Landmarks], Mesh]
    points68: NDArray[np.integer[Any]]


@dataclass(frozen=True)
class Accuracy:
    """One geometry on one head under one light.

    `landmarks` mean distance from the true 68 points in per cent of the distance between the outer eye corners;
    `normals` mean angle in degrees over the face label; `depth` correlation with the true depth; `milliseconds` of
    building the mesh from landmarks.
    """

    geometry: str
    head: str
    light: str
    landmarks: float
    normals: float
    depth: float
    milliseconds: float


def geometries(models: Mapping[str, MorphableModel]) -> list[Geometry]:
    """FaceMesh itself; then, for each model, the fit and the average face."""
    found = [Geometry("facemesh", facemesh, IBUG68_IN_FACEMESH468)]
    for name, model in models.items():
        points = model.landmarks["ibug68"]
        found.append(Geometry(f"morphable, {name}", partial(morphable, model=model), points))
        found.append(Geometry(f"average, {name}", partial(average, model=model), points))
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
    for head in heads:
        yield from _head(head, geometries(models))


def _head(head: Path, ways: list[Geometry]) -> Iterator[Accuracy]:
    points = np.asarray(json.loads((head / "meta.json").read_text(encoding="utf-8"))["landmarks68"], np.float64)
    label = (read_image(head / "labels.png").pixels[..., 1] > 0.5).astype(np.float32)
    with np.load(head / "aov.npz") as maps:
        normals, depth = maps["normal"].astype(np.float32), maps["depth"].astype(np.float32)
    for light in LIGHTS:
        photo = read_image(head / f"{light}.png")
        landmarks = find_landmarks(photo)
        for way in ways:
            mesh, took = _timed(way.build, landmarks)
            surface = rasterize(mesh, photo)
            both = (surface.coverage > 0) & (label > 0) & (depth > 0) & (depth < _FAR)
            yield Accuracy(
                geometry=way.name,
                head=head.name,
                light=light,
                landmarks=landmark_error(mesh, way.points68, points),
                normals=normal_angle(surface.normals, normals, label),
                depth=correlation(surface.depth[both], -depth[both]),
                milliseconds=took,
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


def _timed(build: Callable[[Landmarks], Mesh], landmarks: Landmarks) -> tuple[Mesh, float]:
    took = []
    for _ in range(_TIMED):
        start = time.perf_counter()
        mesh = build(landmarks)
        took.append(time.perf_counter() - start)
    return mesh, 1e3 * min(took)
