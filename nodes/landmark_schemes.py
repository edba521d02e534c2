"""Schemes of landmarks: their sizes, and the 68 iBUG points among FaceMesh's 468.

The numbers are FaceMesh's own vertex indices (MediaPipe's published face mesh topology: contours of lips, eyes, brows
and face oval), put into the order of the iBUG / Multi-PIE mark-up: jaw 0-16 from the picture's left, brows 17-26, nose
27-35, eyes 36-47, outer lips 48-59, inner lips 60-67.
"""

from __future__ import annotations

import numpy as np

from graphface import UsageError
from graphface.nodes.types import Landmarks


class UnusableLandmarks(UsageError):
    """Landmarks that cannot lie on the face of this photo."""


JAW = (127, 234, 93, 132, 172, 136, 150, 176, 152, 400, 379, 365, 397, 361, 323, 454, 356)


BROWS = (70, 63, 105, 66, 107, 336, 296, 334, 293, 300)


NOSE = (168, 6, 195, 4, 98, 97, 2, 326, 327)


EYES = (33, 160, 158, 133, 153, 144, 362, 385, 387, 263, 373, 380)


OUTER_LIPS = (61, 39, 37, 0, 267, 269, 291, 405, 314, 17, 84, 181)


INNER_LIPS = (78, 82, 13, 312, 308, 317, 14, 87)


IBUG68_IN_FACEMESH468 = np.array(JAW + BROWS + NOSE + EYES + OUTER_LIPS + INNER_LIPS)


POINTS = {"facemesh468": 468, "ibug68": 68}
"""Number of points of each scheme."""


def ibug68(landmarks: Landmarks) -> Landmarks:
    """The same face in the 68-point scheme: points (68, 3); landmarks of that scheme are returned unchanged."""
    if landmarks.scheme == "ibug68":
        return landmarks
    points = landmarks.points[IBUG68_IN_FACEMESH468]
    return Landmarks(points, "ibug68", landmarks.score, landmarks.faces)
