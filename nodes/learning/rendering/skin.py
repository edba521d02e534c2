"""Random albedo of a head: skin tones, lips, brows, make-up, stubble, blotches, a cap of hair; eyes and teeth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphface.nodes.learning.rendering.head_model import CAVITY, EYE, GUMS, SKIN, TEETH, HeadModel
from graphface.nodes.learning.rendering.noise import Values, distance_to_line, noise, ramp

_TONES = np.array([[0.07, 0.035, 0.02], [0.19, 0.095, 0.06], [0.36, 0.2, 0.13], [0.56, 0.36, 0.27], [0.7, 0.5, 0.41]])
"""Linear reflectance of skin from very dark to very fair."""


_HAIR = np.array([[0.012, 0.01, 0.009], [0.04, 0.022, 0.014], [0.14, 0.08, 0.04], [0.32, 0.22, 0.11], [0.3, 0.3, 0.3]])


@dataclass(frozen=True)
class Coat:
    """What covers a head.

    Attributes:
        albedo: (M, 3), linear. roughness: (M,), of the principled reflectance. specular: one value for the head.
        hair: (M,), 1 where the scalp is hair. thickness: (M,), centimetres by which hair stands off the scalp.
    """

    albedo: Values
    roughness: Values
    specular: float
    hair: Values
    thickness: Values


def coat(model: HeadModel, rest: Values, random: np.random.Generator) -> Coat:
    """A coat for one person; `rest` (M, 3) as for `relief`."""
    u = random.uniform
    albedo, roughness = np.zeros((len(rest), 3)), np.full(len(rest), u(0.35, 0.7))
    anchors = model.mean[model.landmarks]
    skin = np.flatnonzero(model.part == SKIN)
    points = rest[skin]
    tone = _mixed(_TONES, u()) * (1 + random.normal(size=3) * 0.05)
    hair_color = _mixed(_HAIR, u() ** 1.5) * u(0.7, 1.3)
    color = _skin(points, anchors, tone, random)
    front = points[:, 2] > 4.5
    color[front] = _painted(points[front], anchors, color[front], tone, random)
    color[front] = _brows(points[front], anchors, color[front], hair_color, random)
    color = _stubble(points, color, hair_color, random)
    hair, thickness = np.zeros(len(rest)), np.zeros(len(rest))
    if u() < 0.8:
        hair[skin] = _scalp(points, random)
        strands = 1 + 0.35 * noise(points * (2.5, 0.5, 0.5), random, 0.3)
        cover = hair[skin][:, None]
        color = color * (1 - cover) + cover * np.clip(hair_color * strands[:, None], 0.004, 0.9)
        thickness[skin] = hair[skin] * np.clip(u(0.1, 1.6) + 0.3 * noise(points, random, 1.5, 2), 0.05, None)
        roughness[skin] += hair[skin] * (u(0.4, 0.7) - roughness[skin])
    albedo[skin] = color
    oily = u(0, 0.25) * ramp(1.8 - np.abs(points[:, 0]), 0.7) * (points[:, 2] > 6) * (1 - hair[skin])
    roughness[skin] = np.clip(roughness[skin] - oily + 0.06 * noise(points, random, 1.0, 2), 0.2, 0.9)
    _inside(model, rest, albedo, roughness, random)
    return Coat(np.clip(albedo, 0.004, 0.95), roughness, float(u(0.1, 0.6)), hair, thickness)


def _mixed(table: Values, place: float) -> Values:
    """Between the rows of a table; the logarithms are interpolated."""
    rows = np.arange(len(table))
    return np.exp([np.interp(place * (len(table) - 1), rows, np.log(table[:, k])) for k in range(3)])


def _skin(points: Values, anchors: Values, tone: Values, random: np.random.Generator) -> Values:
    """Bare skin: redder cheeks, nose and ears, darker lids and eye sockets, blotches, freckles and moles."""
    u = random.uniform
    color = np.tile(tone, (len(points), 1))
    red = np.zeros(len(points))
    for center, size in (((-4.3, 1.0, 8), 2.0), ((4.3, 1.0, 8), 2.0), ((0, 0.4, 13), 1.2), ((0, -6.5, 10.5), 1.2)):
        red += np.exp(-np.square((points - center) / size).sum(axis=1))
    red += 0.6 * ramp(np.abs(points[:, 0]) - 7.6, 0.3)
    color *= np.exp(u(0, 0.5) * red[:, None] * (0.1, -0.35, -0.3))
    sockets = np.zeros(len(points))
    for first, last in ((36, 42), (42, 48)):
        center = anchors[first:last].mean(axis=0) - (0, 0.3, 0)
        sockets += np.exp(-np.square((points - center) / (1.9, 1.2, 2.5)).sum(axis=1))
    color *= np.exp(-u(0, 0.5) * sockets[:, None] * (0.8, 1, 0.9))
    if u() < 0.6:
        strength, scale = u(0.03, 0.2), u(0.5, 3)
        blotches = np.clip(noise(points, random, scale, 2), -2, 2)
        color *= np.exp(strength * blotches[:, None] * (0.5, 1, 1))
    if u() < 0.3:
        spots = ramp(noise(points, random, u(0.12, 0.25)) - u(1.6, 2.4), 0.12) * ramp(points[:, 2] - 6, 1)
        color *= np.exp(-u(0.2, 0.9) * spots[:, None] * (0.7, 1, 1.2))
    for _ in range(random.integers(0, 4)):
        mole = points[random.integers(len(points))]
        color *= 1 - u(0.3, 0.8) * np.exp(-np.square((points - mole) / u(0.1, 0.25)).sum(axis=1))[:, None]
    return color


def _painted(points: Values, anchors: Values, color: Values, tone: Values, random: np.random.Generator) -> Values:
    """Lips, bare or painted; shadow and liner about the eyes; blush; stripes."""
    u = random.uniform
    flat = points[:, :2]
    lips = _inside_polygon(flat, anchors[48:60, :2], 0.08)
    bare = tone * (u(0.8, 1.05), u(0.45, 0.8), u(0.5, 0.85))
    paint = random.uniform(0.02, 0.6, 3) * (1, 0.4, 0.5)
    cover = lips[:, None] * u(0.5, 1)
    color = color * (1 - cover) + cover * (paint if u() < 0.35 else bare)
    if u() < 0.35:  # eye shadow above the eyes, a liner along them
        shadow, liner, opacity = random.uniform(0.03, 0.5, 3), u() < 0.5, u(0.3, 0.9)
        for first in (36, 42):
            ring = anchors[first : first + 6, :2]
            distance = distance_to_line(flat, np.vstack([ring, ring[:1]]))
            above = ramp(flat[:, 1] - ring[:, 1].mean(), 0.1)
            cover = (opacity * np.exp(-((distance / 0.7) ** 2)) * above)[:, None]
            color = color * (1 - cover) + cover * shadow
            if liner:
                color *= 1 - 0.85 * np.exp(-((distance / 0.13) ** 2))[:, None]
    if u() < 0.25:
        for side in (-1, 1):
            cover = u(0.2, 0.5) * np.exp(-np.square((points - (side * 4.8, 1.2, 7.5)) / 1.7).sum(axis=1))[:, None]
            color *= 1 - cover * (0.1, 0.55, 0.45)
    if u() < 0.04:
        stripes = ramp(np.sin(points @ random.normal(size=3) * u(1, 3)) - 0.4, 0.05)[:, None]
        color = color * (1 - stripes) + stripes * random.uniform(0.03, 0.7, 3)
    return color


def _brows(points: Values, anchors: Values, color: Values, hair: Values, random: np.random.Generator) -> Values:
    width, opacity = random.uniform(0.2, 0.42), random.uniform(0.25, 0.95)
    lift = random.uniform(-0.25, 0.1)
    for first in (17, 22):
        distance = distance_to_line(points[:, :2], anchors[first : first + 5, :2] + (0, lift))
        hairs = 1 + 0.35 * noise(points, random, 0.15)
        cover = np.clip(opacity * np.exp(-((distance / width) ** 4)) * hairs, 0, 1)[:, None]
        color = color * (1 - cover) + cover * hair
    return color


def _stubble(points: Values, color: Values, hair: Values, random: np.random.Generator) -> Values:
    """Stubble to a full beard, on a third of the heads."""
    if random.random() > 0.35:
        return color
    edge = (
        -0.9 + 0.4 * noise(points, random, 1.5) - points[:, 1] + 0.22 * np.maximum(np.abs(points[:, 0]) - 3, 0) ** 1.5
    )
    beard = ramp(edge, 0.35) * ramp(points[:, 1] + 10.0, 0.6) * ramp(points[:, 2] - 1.0, 0.8)
    lips = np.exp(-np.square((points - (0, -3.4, 11.2)) / (2.2, 0.75, 3)).sum(axis=1))
    grain = 1 + random.uniform(0, 0.5) * noise(points, random, 0.12)
    cover = np.clip(random.uniform(0.1, 0.85) * beard * (1 - np.clip(1.6 * lips, 0, 1)) * grain, 0, 0.95)[:, None]
    return np.asarray(color * (1 - cover) + cover * hair)


def _scalp(points: Values, random: np.random.Generator) -> Values:
    """1 where hair grows: above a hairline, and behind the ears down to the nape."""
    u = random.uniform
    line = u(8.5, 11.5) + 0.5 * noise(points, random, 1.5, 2)
    recess = u(-0.1, 0.25)
    height = points[:, 1] - line + recess * np.minimum(np.abs(points[:, 0]), 5) + 0.9 * np.maximum(6 - points[:, 2], 0)
    back = ramp(-points[:, 2] + u(0, 2.5), 0.3) * ramp(points[:, 1] + u(-2, 6), 0.5)
    ears = ramp(np.abs(points[:, 0]) - 8.1, 0.15) * (np.abs(points[:, 1] - 2.5) < 4)
    front = ramp(height, 0.25) * ramp(points[:, 1] - u(3, 5.5), 0.3)
    return np.asarray(np.maximum(front, back) * (1 - ears))


def _inside(model: HeadModel, rest: Values, albedo: Values, roughness: Values, random: np.random.Generator) -> None:
    """Eyes, teeth, gums and cavities, in place."""
    albedo[model.part == TEETH] = np.array([0.72, 0.68, 0.58]) * random.uniform(0.7, 1.05)
    albedo[model.part == GUMS] = (0.45, 0.15, 0.14)
    albedo[model.part == CAVITY] = (0.2, 0.07, 0.06)
    iris = _mixed(np.array([[0.03, 0.015, 0.01], [0.12, 0.06, 0.03], [0.12, 0.16, 0.2]]), random.uniform())
    sizes = random.uniform(26, 31), random.uniform(10, 17)
    eyes = model.part == EYE
    for side in (rest[:, 0] < 0, rest[:, 0] >= 0):
        ball = np.flatnonzero(eyes & side)
        if not len(ball):
            continue
        points = rest[ball]
        center = (points.max(axis=0) + points.min(axis=0)) / 2
        ahead = (points[:, 2] - center[2]) / np.maximum(np.linalg.norm(points - center, axis=1), 1e-6)
        albedo[ball] = np.array([0.72, 0.68, 0.66])
        albedo[ball[ahead > np.cos(np.radians(sizes[0]))]] = iris
        albedo[ball[ahead > np.cos(np.radians(sizes[1]))]] = 0.008
    roughness[eyes | (model.part == TEETH)] = 0.15


def _inside_polygon(points: Values, ring: Values, softness: float) -> Values:
    """1 within a ring (k, 2), 0 outside."""
    import cv2

    contour, inside = (ring * 100).astype(np.float32), np.full(len(points), -100.0)
    near = np.flatnonzero(((points > ring.min(axis=0) - 1) & (points < ring.max(axis=0) + 1)).all(axis=1))
    for index in near:
        inside[index] = cv2.pointPolygonTest(contour, (points[index] * 100).tolist(), True)
    return ramp(inside / 100, softness)
