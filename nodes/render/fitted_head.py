"""One surface from the crown to the shoulders, with ears, lids, nostrils and lips, fitted to the points of the face."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.morphable.head_model import builtin_head
from graphface.nodes.morphable.head_regression import HeadRegression, Prior, head_regression
from graphface.nodes.morphable.normals import vertex_normals
from graphface.nodes.render.head_pose import Points, face_points, head_pose
from graphface.nodes.types import Mesh

_ROUNDS = 2
"""Pose and shape are estimated in turn. The shape hardly changes the pose."""


Length = Annotated[float, Field(gt=0, le=10)]


@node("render.fitted_head")
def fitted_head(
    mesh: Mesh,
    *,
    deviation: Annotated[float, Field(ge=0, le=1)] = 0.04,
    width: Length = 0.15,
    noise: Length = 0.05,
    depth_noise: Length = 0.5,
    identity: Annotated[int, Field(ge=0, le=1000)] = 10,
) -> Mesh:
    """A head model (ICT-FaceKit, reduced) whose face follows the 468 points of FaceMesh on a face mesh.

    The face mesh itself isn't part of the result: there is one surface, without a rim where the face ends. It has the
    eyes, nostrils and the line between the lips, which 468 points do not have.

    Args:
        mesh: of `geometry.*`. If too few of its FaceMesh points are known to estimate the pose, or they do not look
            like a face, it is returned as it is, with a warning.
        deviation, width: of the smooth displacement by which the head differs from the model, in eye distances: its
            standard deviation, and that of its kernel.
        noise, depth_noise: standard deviations of a point's error across the line of sight of a frontal camera and
            along it, in eye distances. A network's depth says little: the relief is mostly the model's.
        identity: number of the model's identities to use.

    Returns:
        The head in the camera frame; camera, unit and fit are the face's. It has no FaceMesh points, texture
        coordinates or mirror pairs.
    """
    model = builtin_head()
    used = min(identity, len(model.identity))
    regression = head_regression(model, Prior(deviation, width, noise, depth_noise, used))
    face = face_points(mesh)
    vertices = _posed(regression, face)
    if vertices is None:
        warn("render.fitted_head: the pose of the head cannot be estimated from this mesh; no head is added to it")
        return mesh
    return replace(
        mesh,
        vertices=vertices.astype(np.float32),
        triangles=model.triangles,
        normals=vertex_normals(vertices, model.triangles),
        uv=None,
        mirror=None,
        facemesh=None,
    )


def _posed(regression: HeadRegression, face: Points) -> Points | None:
    """The head's vertices in the camera frame, by the points (468, 3) of the face, NaN where unknown."""
    known = np.asarray(np.isfinite(face).all(axis=1))
    fitted = regression.points
    for _ in range(_ROUNDS):
        pose = head_pose(face[known], fitted[known])
        if pose is None:
            return None
        rotation, scale, origin = pose
        # Points that are unknown are taken to be where the model has them.
        points = np.where(known[:, None], (face - origin) @ rotation / scale, fitted)
        identity, weights = regression.coefficients(points)
        fitted = regression.fitted_points(identity, weights)
    posed: Points = origin + scale * regression.surface(identity, weights) @ rotation.T
    return posed
