"""Random lights: a flash, a window, a hard light from the side, two lamps; each with even light from everywhere."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Lamp:
    """A square area light.

    Attributes:
        direction: from the head towards it, x right, y up, z to the camera; unit length.
        distance, half_size: centimetres.
        radiance: linear RGB.
    """

    direction: tuple[float, float, float]
    distance: float
    half_size: float
    radiance: tuple[float, float, float]


@dataclass(frozen=True)
class Lights:
    """`lamps`, the strongest first, and the `ambient` radiance, linear RGB. `kind` is what they imitate."""

    kind: str
    lamps: tuple[Lamp, ...]
    ambient: tuple[float, float, float]

    def as_json(self) -> dict[str, Any]:
        return asdict(self)


_KINDS = ("flash", "window", "side", "hard", "two", "even")
_SHARES = (0.17, 0.22, 0.22, 0.17, 0.14, 0.08)


def random_lights(random: np.random.Generator, kind: str | None = None) -> Lights:
    """Lights as people are photographed in, or those of a kind; irradiance of about 1 at the head."""
    u = random.uniform
    kind = kind or str(random.choice(_KINDS, p=_SHARES))
    side = float(random.choice([-1, 1]))
    placed: list[tuple[float, float, float, float, float]]  # azimuth, elevation, distance, half size, strength
    if kind == "flash":
        placed, even = [(u(-8, 8), u(-6, 15), u(60, 200), u(1.5, 12), 1.0)], u(0.0, 0.15)
    elif kind in ("window", "even"):
        placed, even = [(u(-35, 35), u(-10, 50), 260.0, u(15, 80), 1.0)], u(0.05, 0.5)
        even = u(1.0, 4.0) if kind == "even" else even
    elif kind == "side":
        placed, even = [(side * u(25, 80), u(-15, 50), 260.0, u(10, 70), 1.0)], u(0.05, 0.4)
    elif kind == "hard":
        placed, even = [(side * u(15, 90), u(-15, 60), 260.0, u(1.5, 9), 1.0)], u(0.04, 0.35)
    else:
        placed = [(u(-85, 85), u(-15, 60), 260.0, u(3, 60), s) for s in (1.0, u(0.2, 0.9))]
        even = u(0.05, 0.4)
    color = np.exp(random.normal(size=3) * (0.05, 0.03, 0.09))
    lamps = tuple(_lamp(*values, color * np.exp(random.normal(size=3) * 0.06)) for values in placed)
    ambient = np.maximum(even * np.exp(random.normal(size=3) * 0.1) / np.pi, 1e-3)
    return Lights(kind, lamps, _triple(ambient))


def _lamp(azimuth: float, elevation: float, distance: float, half: float, strength: float, color: Any) -> Lamp:
    a, e = np.radians([azimuth, elevation])
    direction = (float(np.sin(a) * np.cos(e)), float(np.sin(e)), float(np.cos(a) * np.cos(e)))
    return Lamp(direction, distance, half, _triple(strength * color / (2 * half / distance) ** 2))


def _triple(values: Any) -> tuple[float, float, float]:
    red, green, blue = (float(value) for value in values)
    return red, green, blue
