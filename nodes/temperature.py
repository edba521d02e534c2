"""The color of a black body: kelvin to linear RGB."""

from __future__ import annotations

NEUTRAL = 6500.0
"""Kelvin that are white here; lower temperatures are redder, higher ones bluer."""


_RANGE = (1667.0, 25000.0)
"""Kelvin in which the splines of `_planckian_locus` hold."""


_LUMINANCE = (0.2126, 0.7152, 0.0722)
"""Weights of linear R, G and B in the luminance (ITU-R BT.709)."""


def kelvin_color(kelvin: float) -> tuple[float, float, float]:
    """Linear Rec. 709 RGB of a black body, of luminance 1, relative to the one at 6500 K.

    Each channel is divided by its value at 6500 K, because the photo's white balance makes its own light white.

    Args:
        kelvin: clamped to 1667..25000.

    Returns:
        Red, green, blue; not negative. White at 6500 K.

    >>> [round(value, 3) for value in kelvin_color(6500)]
    [1.0, 1.0, 1.0]
    >>> [round(value, 2) for value in kelvin_color(2856)]  # an incandescent lamp, CIE illuminant A
    [1.78, 0.85, 0.23]
    """
    color = [max(value, 0.0) / neutral for value, neutral in zip(_rgb(kelvin), _rgb(NEUTRAL), strict=True)]
    luminance = sum(weight * value for weight, value in zip(_LUMINANCE, color, strict=True))
    red, green, blue = (value / max(luminance, 1e-6) for value in color)
    return red, green, blue


def _rgb(kelvin: float) -> tuple[float, float, float]:
    """Linear Rec. 709 RGB of a black body of luminance 1. Below 1900 K blue is negative: the color is out of gamut.

    From XYZ by the inverse matrix of IEC 61966-2-1; Y is 1.
    """
    x, y = _planckian_locus(min(max(kelvin, _RANGE[0]), _RANGE[1]))
    big_x, big_z = x / y, (1 - x - y) / y  # y is above 0.25 on the whole locus
    return (
        3.2406 * big_x - 1.5372 - 0.4986 * big_z,
        -0.9689 * big_x + 1.8758 + 0.0415 * big_z,
        0.0557 * big_x - 0.2040 + 1.0570 * big_z,
    )


def _planckian_locus(kelvin: float) -> tuple[float, float]:
    """CIE 1931 (x, y) of a black body: cubic splines of Kim et al., US patent 7024034 (2002), within 1e-3.

    >>> [round(value, 3) for value in _planckian_locus(2856)]  # CIE illuminant A is at (0.4476, 0.4074)
    [0.447, 0.408]
    """
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
