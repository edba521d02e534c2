"""Training pictures of people who look different: hair of somebody else, dyed hair, a scarf, make-up, bare shoulders.

Official portraits show short hair, suits and little make-up. What is put on has known labels.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from graphface.nodes.color import lab
from graphface.nodes.learning.label_paint import Person, painted
from graphface.nodes.learning.label_pictures import TrainingPicture
from graphface.nodes.masks.upright_grid import HEIGHT, UNIT, WIDTH, upright_grid
from graphface.nodes.types import FloatArray

RESHAPED, BORROWED, DYED, SCARF, BARE, PAINTED = 0.4, 0.35, 0.25, 0.08, 0.25, 0.35
"""Chance of each disguise."""

CHIN, FOREHEAD = 152, 10
"""FaceMesh points."""


def disguised(own: Person, donors: Sequence[TrainingPicture], random: Generator) -> Person:
    """The same person under random disguises. `donors`: pictures with much hair."""
    if random.random() < RESHAPED:
        own = reshaped(own, random)
    if donors and random.random() < BORROWED:
        own = with_hair_of(own, donors[int(random.integers(len(donors)))], random)
    if random.random() < BARE:
        own = bare_shouldered(own, random)
    if random.random() < DYED:
        own = dyed(own, random)
    elif random.random() < SCARF:
        own = with_scarf(own, random)
    if random.random() < PAINTED and own.landmarks.scheme == "facemesh468":
        own = painted(own, random)
    return own


def with_hair_of(own: Person, donor: TrainingPicture, random: Generator) -> Person:
    """With the hair of another picture before the head; the hair that is seen beside it takes its color, mostly."""
    grid = upright_grid(donor.landmarks)
    matrix = grid.matrix.copy()
    # Now and then it hangs over a cheek.
    matrix[:, 2] += random.normal(0, (0.05 if random.random() < 0.7 else 0.2) * UNIT, 2)
    grid = type(grid)(matrix)
    pixels, labels = (np.asarray(grid.sampled(part) / 255, np.float32) for part in (donor.pixels, donor.labels))
    if random.random() < 0.5:
        pixels, labels = pixels[:, ::-1], labels[:, ::-1]
    # What is half hair half backdrop would bring the backdrop along.
    alpha = np.clip((labels[..., 1] - 0.35) / 0.5, 0, 1)
    if random.random() < 0.25:  # on one side alone, as a tail or a plait
        right = np.arange(WIDTH) > own.landmarks.points[:, 0].mean()
        alpha = alpha * (right if random.random() < 0.5 else ~right)
    before = lab(own.pixels)
    if random.random() < 0.8 and alpha.sum() > 1:
        wanted = np.average(lab(pixels).reshape(-1, 3), axis=0, weights=alpha.ravel())
        before = _moved(before, own.labels[..., 1], wanted)
    shown = _rgb(before)
    shown += alpha[..., None] * (pixels - shown)
    own_labels = own.labels * (1 - alpha[..., None])
    own_labels[..., 1] += alpha
    return Person(shown, own_labels, alpha + (1 - alpha) * own.person, own.landmarks)


def dyed(own: Person, random: Generator) -> Person:
    """With hair of any color: like the skin beside it, black to white, fair, red, or in a color that no hair has."""
    kind, skin = random.random(), own.labels[..., 0] > 0.8
    if kind < 0.25 and skin.any():
        wanted = np.median(lab(own.pixels)[skin], axis=0) + random.normal(0, 1, 3) * (9, 3, 5)
    elif kind < 0.45:
        wanted = np.array([random.uniform(5, 95), random.normal(2, 3), random.normal(5, 5)])
    elif kind < 0.7:
        wanted = np.array([random.uniform(45, 90), random.normal(5, 4), random.normal(22, 8)])
    else:
        angle, strength = random.uniform(0, 2 * np.pi), random.uniform(15, 65)
        wanted = np.array([random.uniform(8, 80), strength * np.cos(angle), strength * np.sin(angle)])
    moved = _moved(lab(own.pixels), own.labels[..., 1], wanted, np.exp(random.normal(0, 0.3)))
    return Person(_rgb(moved), own.labels, own.person, own.landmarks)


def with_scarf(own: Person, random: Generator) -> Person:
    """With cloth in place of hair; cloth is background."""
    import cv2

    hair = own.labels[..., 1]
    cloth = np.clip(cv2.GaussianBlur(cv2.dilate(hair, np.ones((3, 3), np.uint8)), (0, 0), 0.7) * 1.5, 0, 1)
    cloth = cloth * (1 - own.labels[..., 0]) if random.random() < 0.5 else cloth * (1 - (own.labels[..., 0] > 0.9))
    color, other = random.uniform(0, 1, 3), random.uniform(0, 1, 3)
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    period, angle = random.uniform(4, 20), random.uniform(0, np.pi)
    stripe = 0.5 + 0.5 * np.sin(2 * np.pi * (x * np.cos(angle) + y * np.sin(angle)) / period)
    pattern = color + (stripe[..., None] > 0.5) * (other - color) * (random.random() < 0.35)
    lightness = cv2.GaussianBlur(own.pixels.mean(axis=2), (0, 0), 3.0)
    folds = (lightness / max(float((lightness * cloth).sum() / max(cloth.sum(), 1.0)), 0.05))[..., None]
    shown = own.pixels + cloth[..., None] * (np.clip(pattern * (0.6 + 0.4 * folds), 0, 1) - own.pixels)
    return Person(
        shown.astype(np.float32), own.labels * (1 - cloth[..., None]), cloth + (1 - cloth) * own.person, own.landmarks
    )


def bare_shouldered(own: Person, random: Generator) -> Person:
    """With skin in place of clothes above a neckline, which is face by the labels' meaning."""
    import cv2

    face = own.labels[..., 0]
    if face.sum() < 20:
        return own
    clothes = np.clip(own.person - face - own.labels[..., 1], 0, 1)
    colors = lab(own.pixels)
    skin = np.median(colors[face > 0.8], axis=0) if (face > 0.8).any() else np.array([60.0, 16, 18])
    folds = cv2.GaussianBlur(np.ascontiguousarray(colors[..., 0]), (0, 0), random.uniform(1.5, 4))
    folds = folds - (folds * clothes).sum() / max(float(clothes.sum()), 1.0)
    y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float32)
    shaded = np.empty_like(colors)
    shaded[..., 0] = skin[0] + random.normal(-4, 6) + random.uniform(0, 0.35) * folds
    shaded[..., 0] += random.normal(0, 6) * (x / WIDTH - 0.5) + random.normal(-4, 6) * (y / HEIGHT - 0.7)
    shaded[..., 1:] = skin[1:] + random.normal(0, 2.5, 2)
    chin, middle = own.landmarks.points[CHIN if own.landmarks.scheme == "facemesh468" else 8, 1::-1]
    slope = random.normal(0, 0.5)
    line = chin + UNIT * random.uniform(0.4, 3.0) + slope * np.abs(x - middle)
    bare = clothes * np.clip(line - y + 0.5, 0, 1)
    shown = own.pixels + bare[..., None] * (_rgb(shaded) - own.pixels)
    labels = own.labels.copy()
    labels[..., 0] += bare
    return Person(shown, labels, own.person, own.landmarks)


def reshaped(own: Person, random: Generator) -> Person:
    """With hair that stands out more or less, necks and shoulders of another width: the face itself stays."""
    import cv2

    y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float32)
    middle = own.landmarks.points[:, :2].mean(axis=0)
    away = np.stack([x - middle[0], y - middle[1]], axis=2)
    coarse = random.normal(0, 0.12 * UNIT, (6, 5, 2)).astype(np.float32)
    moved = cv2.resize(coarse, (WIDTH, HEIGHT), interpolation=cv2.INTER_CUBIC) + away * np.float32(
        random.normal(0, 0.1)
    )
    # Ears and the rim of the face begin .5 from its middle.
    moved *= np.clip(np.hypot(away[..., 0], away[..., 1]) / UNIT - 0.6, 0, 1)[..., None]

    def warped(values: FloatArray) -> FloatArray:
        found = cv2.remap(
            values, x + moved[..., 0], y + moved[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
        )
        return np.asarray(found, np.float32)

    return Person(warped(own.pixels), warped(own.labels), warped(own.person), own.landmarks)


def _moved(colors: FloatArray, mask: FloatArray, wanted: np.ndarray, contrast: float = 1.0) -> FloatArray:
    """Colors under a mask, moved so that their mean is `wanted`."""
    total = float(mask.sum())
    if total < 1:
        return colors
    middle = (colors * mask[..., None]).sum(axis=(0, 1)) / total
    # Dark hair has little contrast in its lightness; made fair it has more.
    gain = contrast * np.clip((wanted[0] + 10) / (middle[0] + 10), 0.5, 2.0)
    changed = wanted + (colors - middle) * (gain, contrast, contrast)
    return np.asarray(colors + mask[..., None] * (changed - colors), np.float32)


def _rgb(colors: FloatArray) -> FloatArray:
    import cv2

    colors = np.asarray(colors, np.float32).copy()
    colors[..., 0] = np.clip(colors[..., 0], 0, 100)
    return np.clip(np.asarray(cv2.cvtColor(colors, cv2.COLOR_Lab2RGB), np.float32), 0, 1)
