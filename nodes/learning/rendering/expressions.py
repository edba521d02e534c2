"""One random person in several expressions, near-frontal under even light: what the landmark network reads best.

Expressions are those of talking and posing people, of weights that move together; a face model learned from weights
drawn one by one would spend its components on movements that nobody makes alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.color import encode_srgb
from graphface.nodes.learning.rendering.denoise import denoised
from graphface.nodes.learning.rendering.framing import framed, turned
from graphface.nodes.learning.rendering.head_model import HeadModel
from graphface.nodes.learning.rendering.lights import random_lights
from graphface.nodes.learning.rendering.person import dressed, expressed, random_shape
from graphface.nodes.learning.rendering.picture import interpolated
from graphface.nodes.learning.rendering.scene import path_traced
from graphface.nodes.rasterize import rasterized

_KINDS: tuple[dict[str, float], ...] = (
    {},
    {"mouthSmile": 0.6, "cheekSquint": 0.3, "mouthDimple": 0.2},
    {"mouthSmile": 0.8, "cheekSquint": 0.5, "mouthUpperUp": 0.35, "mouthLowerDown": 0.3, "jawOpen": 0.08},
    {"mouthSmile": 0.8, "cheekSquint": 0.6, "mouthUpperUp": 0.4, "mouthLowerDown": 0.3, "jawOpen": 0.3},
    {"jawOpen": 0.2, "mouthLowerDown": 0.3},
    {"jawOpen": 0.4, "mouthStretch": 0.2, "mouthLowerDown": 0.2},
    {"jawOpen": 0.75, "browOuterUp": 0.3, "browInnerUp": 0.3},
    {"jawOpen": 0.15, "mouthFunnel": 0.6},
    {"mouthPucker": 0.7},
    {"browInnerUp": 0.7, "browOuterUp": 0.7, "eyeWide": 0.6, "jawOpen": 0.35},
    {"browDown": 0.7, "eyeSquint": 0.4, "noseSneer": 0.3, "mouthPress": 0.5},
    {"browInnerUp": 0.6, "mouthFrown": 0.6, "mouthShrugLower": 0.5},
    {"noseSneer": 0.6, "mouthUpperUp": 0.5, "browDown": 0.4, "eyeSquint": 0.3},
    {"eyeBlink": 0.95},
    {"mouthPress": 0.6, "mouthRollLower": 0.4, "mouthRollUpper": 0.4},
)
"""Weights at full strength; of both sides where a name has sides."""

_STRENGTH, _STRAY, _LOPSIDED = (0.5, 1.2), 0.12, 0.12
"""Strength of an expression; largest weights of three others beside it; standard deviation between the sides."""

_TURN, _ROOM = 0.35, 1.35
"""Share of the usual turns of the head, and room about the face: the landmark network's points shift as a head turns,
and miss the outline of a face that fills the picture."""


def expressive_photos(
    model: HeadModel, seed: int, numbers: Iterable[int], *, size: int, samples: int
) -> Iterator[tuple[int, NDArray[np.uint8]]]:
    """(number, sRGB photograph uint8 size x size x 3) of the person of a seed, for each number of an expression.

    A photograph depends on the seed and its number alone; consecutive numbers take different kinds of expression.

    Raises:
        UsageError: mitsuba is not installed.
    """
    random = np.random.default_rng(seed)
    person = dressed(model, random_shape(model, random), random)
    lights = random_lights(random, kind="even")
    wall = tuple(np.full(3, random.uniform(0.05, 0.3)))
    order = random.permutation(len(_KINDS))
    for number in numbers:
        own = np.random.default_rng([seed, number])
        expression = varied(_KINDS[order[number % len(_KINDS)]], model.names, own)
        body, landmarks, _ = turned(*expressed(model, person, expression), own, scale=_TURN)
        view = framed(landmarks, own, size, room=_ROOM)
        noisy = path_traced(body, view, lights, wall, samples=samples, seed=int(own.integers(2**31)))
        eyes = float(np.linalg.norm(landmarks[36] - landmarks[45]))
        mesh = view.mesh(body.vertices, body.triangles, body.normals, eyes)
        surface = rasterized(mesh, (size, size), smoothing=0.0)
        covered = surface.coverage > 0
        everywhere = np.full(covered.shape, 255, np.uint8)
        albedo = interpolated(body.albedo, surface, mesh)
        radiance = denoised(noisy, albedo, surface.normals, everywhere, covered)
        level = np.percentile(radiance[covered], 80) if covered.any() else 1.0
        encoded = encode_srgb(np.clip(radiance * np.float32(0.5 / max(float(level), 1e-5)), 0, 1))
        yield number, np.round(encoded * 255).astype(np.uint8)


def varied(kind: dict[str, float], names: tuple[str, ...], random: np.random.Generator) -> dict[str, float]:
    """Weights by name of the model, 0 to 1: a kind at random strength, not the same on both sides, and strays."""
    weights = dict.fromkeys(map(str, random.choice(names, 3, replace=False)), 0.0)
    weights = {name: float(random.uniform(0, _STRAY)) for name in weights}
    strength = random.uniform(*_STRENGTH)
    for name, weight in kind.items():
        amount = weight * strength * random.uniform(0.7, 1.2)
        for side in ("", "_L", "_R"):
            if name + side in names:
                lopsided = 1 + _LOPSIDED * random.normal() if side else 1.0
                weights[name + side] = float(np.clip(amount * lopsided, 0, 1))
    return weights
