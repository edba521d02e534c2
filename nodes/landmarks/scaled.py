"""Landmarks of a photo in a copy of another size."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphface import node
from graphface.nodes.types import Image, Landmarks


@node("landmarks.scaled")
def scaled(landmarks: Landmarks, photo: Image, copy: Image) -> Landmarks:
    """Points of `photo` in the pixels of `copy`, which shows the same at another size.

    Args:
        landmarks: in pixels of `photo`; z is scaled by the mean of both axes.

    Returns:
        The same object where both have one size.
    """
    if (photo.width, photo.height) == (copy.width, copy.height):
        return landmarks
    across, down = copy.width / photo.width, copy.height / photo.height
    points = landmarks.points.copy()
    # Integers are the middles of pixels.
    points[:, :2] = (points[:, :2] + np.float32(0.5)) * np.array([across, down], np.float32) - np.float32(0.5)
    points[:, 2] *= np.float32((across + down) / 2)
    return replace(landmarks, points=points)
