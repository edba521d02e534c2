"""Backdrops for training pictures of the label network: studio walls, clutter, other pictures, walls like the head.

Official portraits have a flag and a blue wall behind them. Other photographs have anything, also what looks like skin
or like the hair before it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from graphface.nodes.learning.label_pictures import TrainingPicture
from graphface.nodes.masks.upright_grid import HEIGHT, UNIT, WIDTH
from graphface.nodes.types import FloatArray

Color = NDArray[np.float64]

_KINDS = ("studio", "color", "like the head", "plate", "picture", "clutter")
_CHANCES = (0.2, 0.12, 0.22, 0.18, 0.14, 0.14)


def backdrop(others: Sequence[TrainingPicture], own: Sequence[Color], random: Generator) -> FloatArray:
    """A random backdrop, sRGB HEIGHT x WIDTH x 3 within [0, 1].

    Args:
        others: pictures to take backdrops from. own: colors of the head that it will stand behind, sRGB.
    """
    kind = str(random.choice(_KINDS, p=_CHANCES))
    if kind == "plate":
        return _part(others[int(random.integers(len(others)))].plate, random)
    if kind == "picture":
        return _blurred(_part(others[int(random.integers(len(others)))].pixels, random), random.uniform(0.5, 7))
    if kind == "clutter":
        return _blurred(_clutter(own, random), random.exponential(2.0))
    if kind == "like the head" and own:
        color = own[int(random.integers(len(own)))] * np.exp(random.normal(0, 0.2)) + random.normal(0, 0.04, 3)
    elif kind == "studio":
        color = random.choice([0.0, 0.03, 0.5, 0.9, 1.0]) + random.normal(0, 0.03) + random.normal(0, 0.015, 3)
    else:
        color = random.uniform(0, 1, 3)
    return _wall(color, random)


def padding(middle: FloatArray, random: Generator) -> FloatArray:
    """1 in margins along one to three sides, tilted as those of a photo that was turned upright; HEIGHT x WIDTH.

    Args:
        middle: (2,), x and y of the face's middle, which stays free.
    """
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    tilt, cut = random.normal(0, 0.15), np.zeros((HEIGHT, WIDTH), np.float32)
    for side in random.permutation(4)[: int(random.integers(1, 4))]:
        angle = side * np.pi / 2 + tilt
        beyond = (x - middle[0]) * np.cos(angle) + (y - middle[1]) * np.sin(angle) - UNIT * random.uniform(0.9, 2.6)
        cut = np.maximum(cut, np.clip(beyond + 0.5, 0, 1).astype(np.float32))
    return cut


def _wall(color: Color, random: Generator) -> FloatArray:
    """One color, mostly with a gradient or a bright or dark spot; some walls are rough."""
    y, x = np.mgrid[-1 : 1 : HEIGHT * 1j, -1 : 1 : WIDTH * 1j]
    wall = np.repeat(np.repeat(color[None, None], HEIGHT, 0), WIDTH, 1)
    if random.random() < 0.6:
        slope = random.normal(0, 0.12, (2, 1)) + random.normal(0, 0.04, (2, 3))
        wall = wall + x[..., None] * slope[0] + y[..., None] * slope[1]
    if random.random() < 0.3:
        middle, width = random.uniform(-0.7, 0.7, 2), random.uniform(0.4, 1.2)
        spot = np.exp(-(np.square(x - middle[0]) + np.square(y - middle[1])) / width**2)
        wall = wall + (random.normal(0, 0.25) + random.normal(0, 0.05, 3)) * spot[..., None]
    if random.random() < 0.2:
        wall = wall + random.normal(0, random.uniform(0, 0.05), (HEIGHT, WIDTH, 1))
    return np.clip(wall, 0, 1).astype(np.float32)


def _part(picture: NDArray[np.uint8], random: Generator) -> FloatArray:
    """A square part of another picture, turned by quarter turns."""
    import cv2

    least = min(picture.shape[:2])
    size = int(random.integers(least // 2, least + 1))
    top, left = (int(random.integers(0, side - size + 1)) for side in picture.shape[:2])
    part = np.ascontiguousarray(np.rot90(picture[top : top + size, left : left + size], int(random.integers(4))))
    return np.asarray(cv2.resize(part, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA) / 255, np.float32)


def _clutter(own: Sequence[Color], random: Generator) -> FloatArray:
    """Things one before the other: ellipses, bars and strands in a few colors, the head's own among them."""
    import cv2

    colors = [random.uniform(0, 1, 3) for _ in range(int(random.integers(2, 6)))]
    colors += [color for color in own if random.random() < 0.5]
    scene = np.full((HEIGHT, WIDTH, 3), colors[0], np.float32)
    for _ in range(int(random.integers(5, 60))):
        color = colors[int(random.integers(len(colors)))] + random.normal(0, 0.08)
        place = tuple(int(c) for c in random.uniform(0, (WIDTH, HEIGHT)))
        size = random.exponential(9) + 1
        axes = (int(size) + 1, int(size * random.uniform(0.05, 1)) + 1)
        shade = tuple(float(c) for c in np.clip(color, 0, 1))
        if random.random() < 0.6:
            cv2.ellipse(scene, place, axes, random.uniform(0, 360), 0, 360, shade, -1, cv2.LINE_AA)
        else:
            end = tuple(int(c) for c in np.asarray(place) + random.normal(0, 30, 2))
            cv2.line(scene, place, end, shade, int(random.integers(1, 6)), cv2.LINE_AA)
    return np.clip(scene, 0, 1)


def _blurred(picture: FloatArray, width: float) -> FloatArray:
    import cv2

    return picture if width < 0.3 else np.asarray(cv2.GaussianBlur(picture, (0, 0), width), np.float32)
