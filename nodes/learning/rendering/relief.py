"""Relief that the linear model does not know: bumps, wrinkles, folds and the roughness of skin.

A network that refines the model's normals learns what is missing in it. On heads of the bare model it would only learn
the residual of the fit. All of it is a height along the normal, a function of the vertex's place on the mean head.
"""

from __future__ import annotations

import numpy as np

from graphface.nodes.learning.rendering.head_model import SKIN, HeadModel
from graphface.nodes.learning.rendering.noise import Values, distance_to_line, noise, ramp

_MARGIN = 1.2
"""Centimetres about a wrinkle in which it is computed."""


def relief(model: HeadModel, rest: Values, random: np.random.Generator) -> Values:
    """Heights (M,) in centimetres.

    Args:
        rest: places of the refined vertices on the person's head without expression and pose, (M, 3).
    """
    height = np.zeros(len(rest))
    skin = np.flatnonzero(model.part == SKIN)
    points = rest[skin]
    anchors = model.mean[model.landmarks]
    found = np.zeros(len(skin))
    for _ in range(random.integers(1, 3)):
        scale = float(np.exp(random.uniform(np.log(0.5), np.log(3.5))))
        found += scale * random.uniform(0.004, 0.03) * noise(points, random, scale, 2)
    front = ramp(points[:, 2] - 3.0, 1.0)
    if random.random() < 0.8:  # fine relief: uneven, scarred or rough skin
        scale = random.uniform(0.18, 0.5)
        where = ramp(noise(points, random, 3.0) + random.uniform(-0.5, 1), 0.3)
        found += front * where * scale * random.uniform(0.005, 0.035) * noise(points, random, scale, 2)
    if random.random() < 0.7:
        found += _wrinkles(points, anchors, random, age=random.uniform(0.15, 1.0))
    height[skin] = found * _away_from_openings(points, anchors)
    return height


def _away_from_openings(points: Values, anchors: Values) -> Values:
    """1 on open skin, 0 at the edges of lids and lips, where displaced sheets would cross."""
    fade = np.ones(len(points))
    for first, last, reach in ((36, 42, 0.45), (42, 48, 0.45), (60, 68, 0.35)):
        ring = np.vstack([anchors[first:last, :2], anchors[first, :2]])
        near = points[:, 2] > 4
        distance = distance_to_line(points[near, :2], ring)
        fade[near] *= np.clip(distance / reach - 0.35, 0, 1)
    nostrils = np.linalg.norm(points[:, None, :] - anchors[None, [32, 34]], axis=2).min(axis=1)
    return np.asarray(fade * np.clip(nostrils / 0.7 - 0.3, 0, 1))


def _wrinkles(points: Values, anchors: Values, random: np.random.Generator, age: float) -> Values:
    """Grooves along the lines in which faces fold."""
    found = np.zeros(len(points))
    for corners, depth, width in _lines(anchors, random, age):
        corners = corners + random.normal(size=corners.shape) * 0.08
        low, high = corners.min(axis=0) - _MARGIN, corners.max(axis=0) + _MARGIN
        near = np.flatnonzero(((points[:, :2] > low) & (points[:, :2] < high)).all(axis=1) & (points[:, 2] > 2.5))
        flat = points[near, :2]
        flat = flat + 0.06 * np.stack([noise(points[near], random, 0.8) for _ in range(2)], axis=1)
        distance = distance_to_line(flat, corners)
        ends = np.minimum(*(np.linalg.norm(flat - corners[k], axis=1) for k in (0, -1)))
        groove = np.exp(-((distance / width) ** 2)) - 0.45 * np.exp(-((distance / (2.6 * width)) ** 2))
        found[near] -= depth * groove * np.clip(ends / (3 * width), 0.15, 1)
    return found


def _lines(anchors: Values, random: np.random.Generator, age: float) -> list[tuple[Values, float, float]]:
    """(corners (k, 2), depth, width) of each groove, centimetres."""
    u = random.uniform
    flat, lines = anchors[:, :2], []

    def add(corners: list[tuple[float, float]] | Values, strength: float, width: float) -> None:
        lines.append((np.asarray(corners, np.float64), age * strength * u(0.4, 1.2), width))

    for side, wing, corner, outer, inner in ((-1, 31, 48, 36, 39), (1, 35, 54, 45, 42)):
        start, end = flat[wing] + (side * 0.35, 0.25), flat[corner] + (side * u(0.4, 0.9), u(-0.3, 0.4))
        middle = (start + end) / 2 + (side * u(0.25, 0.5), 0.1)
        add(np.stack([start, middle, end]), 0.13, u(0.14, 0.3))  # nasolabial fold
        if random.random() < age:
            below = flat[corner] + (side * 0.3, -0.3)
            add(np.stack([below, _moved(below, side * u(0, 0.3), -u(0.6, 1.6))]), 0.08, u(0.12, 0.25))
        for _ in range(random.integers(0, 5)):  # crow's feet
            a = flat[outer] + (side * u(0.4, 0.7), u(-0.5, 0.5))
            add(np.stack([a, _moved(a, side * u(0.5, 1.2), u(-0.7, 0.5))]), 0.035, u(0.06, 0.11))
        for k in range(random.integers(0, 3)):  # bags and lines under the eye
            drop = 0.55 + 0.3 * k + u(0, 0.2)
            a, b = flat[inner] + (0, -drop * 0.7), flat[outer] + (0, -drop)
            add(np.stack([a, (a + b) / 2 + (0, -0.3), b]), 0.06, u(0.09, 0.2))
        if random.random() < 0.6 * age:  # between the brows
            a = flat[21 if side < 0 else 22] + (-side * u(0.5, 0.9), u(-0.6, 0.1))
            add(np.stack([a, _moved(a, u(-0.15, 0.15), u(0.6, 1.3))]), 0.07, u(0.08, 0.15))
        if random.random() < 0.4:  # cheek lines
            a = flat[corner] + (side * u(1.0, 2.2), u(-0.5, 1.5))
            add(np.stack([a, _moved(a, side * u(0, 0.5), -u(0.8, 2))]), 0.05, u(0.1, 0.2))
    for k in range(random.integers(0, 6)):  # forehead
        y = 7.3 + k * u(0.6, 0.9)
        half = u(2, 4.5)
        add([(-half, y + u(-0.3, 0.2)), (-half / 2, y + u(0, 0.3)), (0, y), (half / 2, y + u(0, 0.3)), (half, y)],
            0.06, u(0.1, 0.2))  # fmt: skip
    if random.random() < 0.4 * age:
        add([(-1.2, -5.2), (0, -4.95), (1.2, -5.2)], 0.08, u(0.12, 0.25))  # above the chin
    return lines


def _moved(point: Values, right: float, up: float) -> Values:
    return np.asarray(point + (right, up))  # noqa: RUF005
