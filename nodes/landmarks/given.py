"""Points that the user gives, instead of a network's."""

from __future__ import annotations

import numpy as np

from graphface import node, warn
from graphface.nodes.landmark_schemes import POINTS, UnusableLandmarks
from graphface.nodes.types import Image, Landmarks


@node("landmarks.given")
def given(photo: Image, points: Landmarks) -> Landmarks:
    """The given points, unchanged, after a check against the photo.

    Points are a graph input (`points: {type: Landmarks}`) and not the name of a file as a parameter, so that their
    content is part of every key, and an edited file is noticed.

    Raises:
        UnusableLandmarks: not (n, 3) for the scheme's n, not finite, wholly outside the photo, or all in one place.
    """
    expected = (POINTS.get(points.scheme, -1), 3)
    if points.points.shape != expected:
        known = ", ".join(f"{scheme} ({n} points)" for scheme, n in POINTS.items())
        raise UnusableLandmarks(f"points of shape {points.points.shape} are no {points.scheme}; known: {known}")
    flat = points.points[:, :2]
    if not np.isfinite(points.points).all():
        raise UnusableLandmarks("the points have values that are not numbers")
    inside = ((flat >= -0.5) & (flat <= np.array([photo.width, photo.height]) - 0.5)).all(axis=1)
    if not inside.any():
        raise UnusableLandmarks(
            f"no point lies in the photo ({photo.width} x {photo.height} pixels): x {flat[:, 0].min():.0f} to "
            f"{flat[:, 0].max():.0f}, y {flat[:, 1].min():.0f} to {flat[:, 1].max():.0f}; were they placed on a copy "
            "of another size?"
        )
    if points.interocular < 1:
        raise UnusableLandmarks("the eyes are less than a pixel apart")
    if inside.mean() < 0.5:
        warn(f"only {inside.sum()} of {len(flat)} given points lie in the photo")
    return points
