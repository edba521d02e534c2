"""Jaw landmarks on the visible outline: as the head turns, the jaw line that a picture shows slides over the face.

Each of the 17 jaw points has a line of candidate vertices, from its own vertex on the mean face towards the nose. In a
given pose the candidate that lies furthest to its side is on the outline (landmark marching: Zhu et al., High-Fidelity
Pose and Expression Normalization for Face Recognition in the Wild, CVPR 2015).
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.model import EYE_CORNERS, MorphableModel
from graphface.nodes.morphable.solve import LEAST_DEPTH, Problem, UpdateProblem, View

CHIN = 8
"""The jaw point on the midline, which does not slide."""


JAW_POINTS = 17
"""The first points of the iBUG scheme."""


_STATIONS = np.linspace(1.0, 0.35, 14)
"""Positions of the candidates as fractions of the angle from the midline (0) to the jaw point (1)."""


_AXIS_BEHIND_EYES = 0.9
"""Distance of the vertical axis that angles are measured about, in eye distances behind the eye corners."""


def sliding_jaw(model: MorphableModel, used: NDArray[np.intp], known: NDArray[np.intp]) -> UpdateProblem | None:
    """What moves the jaw points of a problem to the outline in a view; None where the model has no jaw points.

    Args:
        used: numbers of the coefficients in the problem (K,), identity first.
        known: numbers of the landmarks in the problem (L,), in the iBUG scheme.
    """
    on_jaw = np.flatnonzero((known < JAW_POINTS) & (known != CHIN))
    if len(on_jaw) == 0:
        return None
    lines = jaw_lines(model)[known[on_jaw]]
    means = model.mean[lines].astype(np.float64)
    directions = model.directions[used][:, lines].astype(np.float64)
    points = known[on_jaw]

    def update(problem: Problem, view: View) -> Problem:
        shape = means + np.tensordot(view.x, directions, axes=1)
        placed = shape @ view.rotation.T
        projected = placed[..., :2] / np.maximum(1 - placed[..., 2:] * view.nearness, LEAST_DEPTH)
        chosen = on_outline(projected, view.rotation[:2, 0], points)
        every = np.arange(len(on_jaw))
        new_mean, new_directions = problem.mean.copy(), problem.directions.copy()
        new_mean[on_jaw], new_directions[:, on_jaw] = means[every, chosen], directions[:, every, chosen]
        return replace(problem, mean=new_mean, directions=new_directions)

    return update


@lru_cache(maxsize=16)
def jaw_lines(model: MorphableModel) -> NDArray[np.intp]:
    """Candidate vertices (17, S) of each jaw point, its own first; -1 where the model lacks the point."""
    jaw = model.landmarks["ibug68"][:JAW_POINTS].astype(np.intp)
    lines = np.repeat(jaw[:, None], len(_STATIONS), axis=1)
    corners = model.mean[model.landmarks["ibug68"][list(EYE_CORNERS["ibug68"])]].astype(np.float64)
    positions = model.mean.astype(np.float64) - corners.mean(axis=0)
    angle = np.arctan2(positions[:, 0], positions[:, 2] + _AXIS_BEHIND_EYES)
    height = positions[:, 1]
    front = np.flatnonzero(positions[:, 2] > -_AXIS_BEHIND_EYES)
    for point, vertex in enumerate(jaw):
        if vertex < 0 or point == CHIN:
            continue
        squared = (
            np.square(angle[front, None] - angle[vertex] * _STATIONS)
            + np.square(height[front] - height[vertex])[:, None]
        )
        lines[point, 1:] = front[squared.argmin(axis=0)][1:]
    return lines


def on_outline(
    projected: NDArray[np.float64], across: NDArray[np.float64], points: NDArray[np.intp]
) -> NDArray[np.intp]:
    """The candidate of each jaw point on the outline: indices (n,) into projections (n, S, 2), y up.

    Args:
        across: (2,), direction of the face's own x axis in the picture.
        points: (n,) numbers of the jaw points, 0 to 16.
    """
    reach = projected @ across * np.sign(points - CHIN)[:, None]
    return np.asarray(reach.argmax(axis=1), np.intp)
