"""Make-up on training pictures of the label network: whatever is painted on a face is face."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from graphface.nodes.face_outlines import CHEEKS, EYES, LIDS, LIPS
from graphface.nodes.masks.upright_grid import HEIGHT, UNIT, WIDTH
from graphface.nodes.types import FloatArray, Landmarks

_FINE = 4
"""Supersampling of painted outlines."""


@dataclass
class Person:
    """What the grid shows, HEIGHT x WIDTH (x 3, x 2): `pixels` sRGB, `labels` face and hair, `person` all but backdrop.

    `landmarks` in the grid's pixels.
    """

    pixels: FloatArray
    labels: FloatArray
    person: FloatArray
    landmarks: Landmarks


def painted(own: Person, random: Generator) -> Person:
    """With lipstick, lids, cheeks and foundation in random colors; now and then paint all over the face."""
    face, points = own.labels[..., 0], own.landmarks.points[:, :2]
    shown = own.pixels.copy()

    def paint(area: FloatArray, color: np.ndarray, opacity: float) -> None:
        shown[...] += (face * area * np.float32(opacity))[..., None] * (color.astype(np.float32) - shown)

    wild = random.random() < 0.3
    if random.random() < 0.5:
        oval = _filled([tuple(range(len(points)))], points, 0.8, hull=True)
        skin = np.median(shown[face > 0.8], axis=0) if (face > 0.8).any() else np.full(3, 0.6)
        tone = skin + (1 - skin) * random.uniform(0, 0.6) if random.random() < 0.6 else skin * random.uniform(0.6, 1)
        paint(oval, random.uniform(0, 1, 3) if wild else tone, random.uniform(0.2, 0.9 if wild else 0.6))
    for areas, chance, width in ((LIDS, 0.7, 1.0), (CHEEKS, 0.4, 2.0), (EYES, 0.5, 0.5), ((LIPS,), 0.7, 0.4)):
        if random.random() < chance:
            color = random.uniform(0, 1, 3)
            if areas[0] is LIPS and random.random() < 0.6:
                color = np.array([random.uniform(0.3, 0.9), *random.uniform(0, 0.35, 2)])
            paint(_filled(areas, points, width * random.uniform(0.6, 1.6)), color, random.uniform(0.2, 0.95))
    if wild:
        for _ in range(int(random.integers(1, 5))):
            middle, size = points[int(random.integers(len(points)))], random.uniform(0.1, 0.5) * UNIT
            y, x = np.mgrid[:HEIGHT, :WIDTH]
            distance = np.hypot(x - middle[0], (y - middle[1]) * random.uniform(0.4, 2.5))
            paint(np.clip(size - distance, 0, 1).astype(np.float32), random.uniform(0, 1, 3), random.uniform(0.3, 1))
    return Person(np.clip(shown, 0, 1), own.labels, own.person, own.landmarks)


def _filled(outlines: Sequence[Sequence[int]], points: FloatArray, blur: float, hull: bool = False) -> FloatArray:
    """1 within the outlines, with soft edges."""
    import cv2

    area = np.zeros((HEIGHT * _FINE, WIDTH * _FINE), np.float32)
    for outline in outlines:
        polygon = np.rint((points[list(outline)] + 0.5) * _FINE).astype(np.int32)
        cv2.fillPoly(area, [cv2.convexHull(polygon) if hull else polygon], 1.0)
    small = cv2.resize(area, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA)
    return np.asarray(cv2.GaussianBlur(small, (0, 0), max(blur, 0.3)), np.float32)
