"""The color of a glowing body: kelvin to linear RGB."""

from __future__ import annotations

NEUTRAL = 6500.0
"""Kelvin that are plain white here; lower is warmer, higher is bluer."""


_LUMINANCE = (0.2126, 0.7152, 0.0722)
"""Rec. 709."""


def kelvin_color(kelvin: float) -> tuple[float, float, float]:
    """Linear Rec. 709 RGB of a black body, luminance 1, white at 6500 K; 1667 to 25000 K, never negative.

    The Planckian locus in xy follows Kim et al. 2002 (US patent 7024034, cubic splines good to 1e-3). Each channel is
    divided by its value at 6500 K, since the photo is balanced for what it calls white.
    """
    color = [max(value, 0.0) / neutral for value, neutral in zip(_rgb(kelvin), _rgb(NEUTRAL), strict=True)]
    luminance = sum(weight * value for weight, value in zip(_LUMINANCE, color, strict=True))
    red, green, blue = (value / max(luminance, 1e-6) for value in color)
    return red, green, blue


def _rgb(kelvin: float) -> tuple[float, float, float]:
    """Linear Rec. 709 RGB of the locus at luminance 1; blue is below 0 under 1900 K, outside what RGB can show."""
    x, y = _locus(min(max(kelvin, 1667.0), 25000.0))
    big_x, big_z = x / y, (1 - x - y) / y  # y is above 0.3 on the whole locus
    return (
        3.2406 * big_x - 1.5372 - 0.4986 * big_z,
        -0.9689 * big_x + 1.8758 + 0.0415 * big_z,
        0.0557 * big_x - 0.2040 + 1.0570 * big_z,
    )


def _locus(kelvin: float) -> tuple[float, float]:
    t = 1e3 / kelvin
    if kelvin <= 4000:
        x = ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
    else:
        x = ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390
    if kelvin <= 2222:
        y = ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
    elif kelvin <= 4000:
        y = ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
    else:
        y = ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483
    return x, y
