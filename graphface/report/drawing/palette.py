"""Colors of a drawing, on light and on dark: one for each family of operators, always the same."""

from __future__ import annotations

import colorsys
from dataclasses import dataclass
from typing import Literal
from zlib import crc32

_HUES = 24
_SALT = "2533"
"""Tried out: with it the families of the shipped graphs that stand side by side get hues that differ most."""
Theme = Literal["light", "dark"]


@dataclass(frozen=True)
class Colors:
    """What is not a family's, as "#rrggbb"."""

    paper: str
    box: str
    edge: str
    ink: str
    muted: str
    wire: str
    frame: str
    frame_edge: str
    accent: str
    failed: str
    given: str


LIGHT = Colors(
    paper="#fbfbfa",
    box="#ffffff",
    edge="#c4c8ce",
    ink="#1d2126",
    muted="#5b636e",
    wire="#8b95a3",
    frame="#f1f2f4",
    frame_edge="#c9ced6",
    accent="#0b6bcb",
    failed="#c62828",
    given="#eef1f5",
)
DARK = Colors(
    paper="#15181c",
    box="#22272e",
    edge="#454c56",
    ink="#e8ebef",
    muted="#a3acb8",
    wire="#6f7b8a",
    frame="#1b1f25",
    frame_edge="#39404a",
    accent="#63adf5",
    failed="#ff7b72",
    given="#2b323c",
)
COLORS: dict[Theme, Colors] = {"light": LIGHT, "dark": DARK}


def hue(family: str) -> int:
    """A family's hue in degrees."""
    return crc32(f"{_SALT}{family}".encode()) % _HUES * (360 // _HUES)


def family_color(degrees: int, theme: Theme) -> str:
    """The color of a hue where it is a bar beside text, "#rrggbb"."""
    lightness, saturation = (0.46, 0.62) if theme == "light" else (0.62, 0.58)
    return _hex(colorsys.hls_to_rgb(degrees / 360, lightness, saturation))


def family_tint(degrees: int, theme: Theme) -> str:
    """The color of a hue behind text, "#rrggbb"."""
    lightness, saturation = (0.94, 0.55) if theme == "light" else (0.24, 0.28)
    return _hex(colorsys.hls_to_rgb(degrees / 360, lightness, saturation))


def heat_color(heat: float) -> str:
    """From a cool to a hot color, "#rrggbb", for a share in 0..1."""
    share = min(max(heat, 0.0), 1.0)
    return _hex(colorsys.hls_to_rgb((50 - 50 * share) / 360, 0.52, 0.9))


def _hex(rgb: tuple[float, float, float]) -> str:
    return "#" + "".join(f"{round(part * 255):02x}" for part in rgb)
