"""Augmentation: training pictures with other light, colors, frames and backdrops, and displaced landmarks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator

from graphface.nodes.learning.label_backdrops import Color, backdrop, padding
from graphface.nodes.learning.label_disguises import disguised
from graphface.nodes.learning.label_paint import Person
from graphface.nodes.learning.label_pictures import Bytes, TrainingPicture
from graphface.nodes.masks.network_input import mirrored_input, network_input
from graphface.nodes.masks.upright_grid import HEIGHT, UNIT, WIDTH, upright_grid
from graphface.nodes.types import FloatArray, Landmarks

UNCERTAIN_WEIGHT = 0.25
"""Weight of a pixel that the teacher is uncertain of, relative to a certain one."""

BEFORE_ANOTHER = 0.6
"""Share of pictures whose person stands before another backdrop."""

CONTINUED = 0.3
"""Share of pictures that go on below the photo's frame with what stands at its edge, as clothes and long hair do."""

PADDED = 0.2
"""Share of pictures with margins of one grey within their frame."""


@dataclass(frozen=True)
class Example:
    """`cells` (HEIGHT/2, WIDTH/2, C), the network's input; `labels` HEIGHT x WIDTH x 3, `weight` HEIGHT x WIDTH."""

    cells: FloatArray
    labels: FloatArray
    weight: FloatArray


def example(
    picture: TrainingPicture,
    others: Sequence[TrainingPicture],
    random: Generator,
    donors: Sequence[TrainingPicture] = (),
) -> Example:
    """A random variation of a picture; its backdrop may come from the others, its hair from the donors."""
    landmarks = _displaced(picture.landmarks, random)
    grid = upright_grid(landmarks)

    def sampled(values: Bytes) -> FloatArray:
        return np.asarray(grid.sampled(values) / 255, np.float32)

    inside = sampled(picture.inside) > 0.5
    if random.random() < CONTINUED:
        inside = np.maximum.accumulate(inside, axis=0)
    framed = inside * _frame(random)
    seen = Person(sampled(picture.pixels), sampled(picture.labels), sampled(picture.person), grid.to_grid(landmarks))
    if random.random() < BEFORE_ANOTHER:
        new = backdrop(others, _colors(seen, random), random)
        # The old backdrop is taken out of edges, so that no rim of it stays around the hair.
        seen.pixels = np.clip(seen.pixels + (1 - seen.person[..., None]) * (new - sampled(picture.plate)), 0, 1)
    seen = disguised(seen, donors, random)
    pixels, labels, person = seen.pixels, seen.labels, seen.person
    pixels = _recolored(pixels, labels, person, random)
    pixels = _recaptured(_lit(pixels, random), random)
    if random.random() < PADDED:
        margin = padding(seen.landmarks.points[:, :2].mean(axis=0), random)[..., None]
        pixels = pixels + margin * (np.float32(random.choice([0, 0, 0, 1, random.random()])) - pixels)
        labels = labels * (1 - margin)
    input_ = network_input(pixels, np.asarray(framed, np.float32), grid.layout(landmarks))
    target = np.dstack([labels, np.maximum(1 - labels.sum(axis=2), 0)])
    target /= np.maximum(target.sum(axis=2, keepdims=True), 1e-6)
    certainty = np.clip(2 * target.max(axis=2) - 1, 0, 1)
    weight = framed * (UNCERTAIN_WEIGHT + (1 - UNCERTAIN_WEIGHT) * certainty)
    if random.random() < 0.5:
        input_, target, weight = mirrored_input(input_), target[:, ::-1], weight[:, ::-1]
    return Example(
        np.ascontiguousarray(input_, np.float32),
        np.ascontiguousarray(target, np.float32),
        np.ascontiguousarray(weight, np.float32),
    )


def _displaced(landmarks: Landmarks, random: Generator) -> Landmarks:
    """Landmarks as another detector might give them: moved, rotated and scaled a little, each with some noise."""
    points = landmarks.points.copy()
    unit, middle = landmarks.interocular, points[:, :2].mean(axis=0)
    turn, grow = random.normal(0, 0.06), np.exp(random.normal(0, 0.04, 2))
    cos, sin = np.cos(turn), np.sin(turn)
    moved = (points[:, :2] - middle) * grow @ np.array([[cos, sin], [-sin, cos]])
    noise = random.normal(0, 0.008, moved.shape) + random.normal(0, 0.03, 2)
    points[:, :2] = middle + moved + noise * unit
    return replace(landmarks, points=points.astype(np.float32))


def _frame(random: Generator) -> FloatArray:
    """1 within a random frame: the whole grid, a frame that cuts the head, or a tight crop of the face."""
    inside = np.ones((HEIGHT, WIDTH), np.float32)
    kind = random.random()
    chance, furthest = (0.0, 0.0) if kind < 0.35 else (0.4, 2.8) if kind < 0.6 else (0.85, 1.6)
    for side in (inside, inside[::-1], inside.T, inside.T[::-1]):
        if random.random() < chance:
            side[len(side) // 2 + round(UNIT * random.uniform(0.7, furthest)) :] = 0
    return inside


def _colors(seen: Person, random: Generator) -> list[Color]:
    """A color of the skin and one of the hair, sRGB."""
    found = []
    for label in (0, 1):
        mask = seen.labels[..., label] > 0.8
        if mask.any():
            own = seen.pixels[mask]
            found.append(np.asarray(own[int(random.integers(len(own)))], np.float64))
    return found


def _recolored(pixels: FloatArray, labels: FloatArray, person: FloatArray, random: Generator) -> FloatArray:
    """Skin, hair, clothes and backdrop in other colors, each with its own probability."""
    import cv2

    face, hair = labels[..., 0], labels[..., 1]
    parts = (
        (face, 0.3, 10, 6, 0.15),
        (hair, 0.35, 18, 12, 0.25),
        (np.maximum(person - face - hair, 0), 0.4, 25, 25, 0.5),
        (1 - person, 0.3, 25, 20, 0.5),
    )
    chosen = [part for part in parts if random.random() < part[1]]
    if not chosen:
        return pixels
    lab = cv2.cvtColor(np.clip(pixels, 0, 1), cv2.COLOR_RGB2Lab)
    for mask, _, lightness, hue, contrast in chosen:
        if not mask.any():
            continue
        middle = (lab * mask[..., None]).sum(axis=(0, 1)) / max(float(mask.sum()), 1.0)
        new = middle + random.normal(0, 1, 3) * (lightness, hue, hue)
        changed = new + (lab - middle) * np.exp(random.normal(0, contrast))
        lab += mask[..., None] * (changed - lab).astype(np.float32)
    lab[..., 0] = np.clip(lab[..., 0], 0, 100)
    return np.asarray(cv2.cvtColor(lab.astype(np.float32), cv2.COLOR_Lab2RGB), np.float32)


def _lit(pixels: FloatArray, random: Generator) -> FloatArray:
    """Another exposure, white balance and contrast; light that falls off across the picture, sometimes colored."""
    across = np.linspace(-1, 1, pixels.shape[1], dtype=np.float32)[None, :, None]
    down = np.linspace(-1, 1, pixels.shape[0], dtype=np.float32)[:, None, None]
    slopes = random.normal(0, 0.3, (2, 1)) * np.ones(3)
    if random.random() < 0.15:
        slopes = slopes + random.normal(0, 0.5, (2, 3))
    gain = random.normal(0, 0.15) + random.normal(0, 0.08, 3)
    if random.random() < 0.15:
        gain = gain + random.uniform(0.1, 0.7)  # high key: skin and wall are nearly white
    light = np.exp(across * slopes[0] + down * slopes[1] + gain).astype(np.float32)
    power = np.float32(np.exp(random.normal(0, 0.25)))
    return np.asarray(np.clip(np.clip(pixels, 0, 1) ** power * light, 0, 1), np.float32)


def _recaptured(pixels: FloatArray, random: Generator) -> FloatArray:
    """As if by another camera: grey, blurred, sharpened, noisy."""
    import cv2

    if random.random() < 0.12:
        grey = pixels.mean(axis=2, keepdims=True)
        pixels = grey + random.uniform(0, 0.3) * (pixels - grey)
    if random.random() < 0.25:
        pixels = np.asarray(cv2.GaussianBlur(pixels, (0, 0), random.uniform(0.3, 1.2)), np.float32)
    elif random.random() < 0.2:
        soft = np.asarray(cv2.GaussianBlur(pixels, (0, 0), 1.0), np.float32)
        pixels = pixels + random.uniform(0, 1.2) * (pixels - soft)
    if random.random() < 0.3:
        pixels = pixels + random.normal(0, random.uniform(0, 0.04), pixels.shape).astype(np.float32)
    return np.clip(pixels, 0, 1).astype(np.float32)
