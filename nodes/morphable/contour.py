"""The jaw line that a picture shows is not always the same line on the face: as the head turns, it slides.

Each of the 17 jaw points gets a line of candidate vertices, from its own place on the mean face towards the nose. At a
given pose the candidate that reaches furthest to its side is the one seen (landmark marching: Zhu et al., High-Fidelity
Pose and Expression Normalization for Face Recognition in the Wild, CVPR 2015).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.morphable.model import EYE_CORNERS, MorphableModel

CHIN = 8
"""The jaw point that lies on the mid-line, and stays."""


JAW_POINTS = 17


_STATIONS = np.linspace(1.0, 0.35, 14)
"""Where on the way from the jaw point (1) to the mid-line (0) candidates lie."""


_AXIS_BEHIND_EYES = 0.9
"""The vertical axis that the face is unrolled about, in eye distances behind the eye corners."""


def jaw_lines(model: MorphableModel) -> NDArray[np.intp]:
    """Candidate vertices (17, S) of each jaw point, its own first; -1 throughout where the model lacks the point."""
    jaw = model.landmarks["ibug68"][:JAW_POINTS].astype(np.intp)
    lines = np.repeat(jaw[:, None], len(_STATIONS), axis=1)
    corners = model.mean[model.landmarks["ibug68"][list(EYE_CORNERS["ibug68"])]].astype(np.float64)
    middle = corners.mean(axis=0)
    places = model.mean.astype(np.float64) - middle
    angle = np.arctan2(places[:, 0], places[:, 2] + _AXIS_BEHIND_EYES)
    height = places[:, 1]
    front = np.flatnonzero(places[:, 2] > -_AXIS_BEHIND_EYES)
    for point, vertex in enumerate(jaw):
        if vertex < 0 or point == CHIN:
            continue
        apart = (
            np.square(angle[front, None] - angle[vertex] * _STATIONS)
            + np.square(height[front] - height[vertex])[:, None]
        )
        lines[point, 1:] = front[apart.argmin(axis=0)][1:]
    return lines


def seen(projected: NDArray[np.float64], across: NDArray[np.float64], points: NDArray[np.intp]) -> NDArray[np.intp]:
    """Which candidate of each jaw point lies on the outline: (n,) of the projections (n, S, 2), y up.

    Args:
        across: (2,), where the face's own x axis points in the picture.
        points: (n,) numbers of the jaw points, 0 to 16.
    """
    reach = projected @ across * np.sign(points - CHIN)[:, None]
    return np.asarray(reach.argmax(axis=1), np.intp)
