"""Smooth random functions in space: sums of waves of random direction and phase."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]
_WAVES = 20


def noise(points: Values, random: np.random.Generator, scale: float, octaves: int = 1) -> Values:
    """A random function of about unit variance at points (n, 3).

    Args:
        scale: typical distance from a hill to the next valley, in the points' unit.
        octaves: each adds waves of half the length and .6 of the height.
    """
    single = points.astype(np.float32)
    total, power = np.zeros(len(points), np.float32), 0.0
    for octave in range(octaves):
        gain = 0.6**octave
        waves = random.normal(size=(3, _WAVES)) * (1.6 * 2**octave / scale)
        angles = single @ waves.astype(np.float32)
        angles += random.uniform(0, 2 * np.pi, _WAVES).astype(np.float32)
        total += np.cos(angles, out=angles) @ np.full(_WAVES, gain * np.sqrt(2 / _WAVES), np.float32)
        power += gain * gain
    return np.asarray(total / np.sqrt(power), np.float64)


def distance_to_line(points: Values, corners: Values) -> Values:
    """Distance of points (n, 2) from a polyline (k, 2): (n,)."""
    nearest = np.full(len(points), np.inf)
    for a, b in pairwise(corners):
        along = b - a
        share = np.clip((points - a) @ along / max(float(along @ along), 1e-12), 0, 1)
        nearest = np.minimum(nearest, np.hypot(*(points - a - share[:, None] * along).T))
    return nearest


def ramp(values: Values, width: float) -> Values:
    """From 0 (far below zero) to 1 (far above) within a few widths."""
    return np.asarray(1 / (1 + np.exp(-np.clip(values / width, -30, 30))))
