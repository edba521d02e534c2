"""The solution of a fit as a mesh in the camera frame."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.morphable.fit_problem import PhotoFit, ReducedModel
from graphface.nodes.morphable.mirror import mirror_vertices
from graphface.nodes.morphable.model import EYE_CORNERS, MorphableModel
from graphface.nodes.morphable.normals import vertex_normals
from graphface.nodes.morphable.solve import Problem, Solution, residuals
from graphface.nodes.types import Camera, FitRecord, Mesh

_POOR_RESIDUAL = 0.25
"""A residual above this, in eye distances, means that the model does not fit the points."""


def fitted_mesh(reduced: ReducedModel, photo: PhotoFit, solution: Solution, index: int) -> Mesh:
    """The mesh of the photograph number `index` of a solution, and the record of its fit."""
    view, model = solution.views[index], reduced.model
    coefficients = np.zeros(len(model.identity) + len(model.expression))
    coefficients[reduced.used] = view.x
    vertices = view.scale * model.vertices(coefficients) @ view.rotation.T
    vertices[:, :2] += view.offset
    record = _record(model, coefficients, photo, solution, index)
    if record.residual > _POOR_RESIDUAL * view.scale:
        warn(f"the model {model.name!r} lies {record.residual:.1f} pixels from the landmarks: it does not fit them")
    if not solution.converged:
        warn(f"the fit did not converge in {len(solution.costs) - 1} steps")
    return Mesh(
        vertices=vertices.astype(np.float32),
        triangles=model.triangles,
        normals=vertex_normals(vertices, model.triangles),
        camera=Camera(center=photo.center, nearness=view.nearness / view.scale),
        interocular=_interocular(model, vertices, view.scale),
        uv=model.uv,
        mirror=mirror_vertices(model),
        facemesh=model.landmarks.get("facemesh468"),
        fit=record,
    )


def _record(
    model: MorphableModel, coefficients: NDArray[np.float64], photo: PhotoFit, solution: Solution, index: int
) -> FitRecord:
    view, problem = solution.views[index], solution.problems[index]
    errors = np.zeros(photo.count)
    errors[photo.known] = np.linalg.norm(residuals(problem, view), axis=1)
    split = len(model.identity)
    return FitRecord(
        model=model.name,
        identity=coefficients[:split].astype(np.float32),
        expression=coefficients[split:].astype(np.float32),
        rotation=view.rotation,
        scale=view.scale,
        distance=1 / view.nearness if view.nearness > 0 else 0.0,
        residual=_residual(errors[photo.known], problem),
        errors=errors.astype(np.float32),
        costs=np.asarray(solution.costs, np.float32),
        condition=solution.condition,
        converged=solution.converged,
    )


def _residual(errors: NDArray[np.float64], problem: Problem) -> float:
    """Root mean square of the errors, with the robust weights of the fit."""
    weights = 1 / np.square(1 + np.square(errors / max(problem.robust * problem.pixel, 1e-9)))
    return float(np.sqrt(np.average(np.square(errors), weights=np.maximum(weights, 1e-12))))


def _interocular(model: MorphableModel, vertices: NDArray[np.float64], scale: float) -> float:
    """Distance of the outer eye corners of the fitted face, pixels at its depth."""
    for scheme, corners in EYE_CORNERS.items():
        at = model.landmarks.get(scheme)
        if at is not None and min(at[corners[0]], at[corners[1]]) >= 0:
            return float(np.linalg.norm(vertices[at[corners[0]]] - vertices[at[corners[1]]]))
    return scale
