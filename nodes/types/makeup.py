"""Makeup as a layer over skin: what skin would look like without it, and the layer itself."""

from __future__ import annotations

from dataclasses import dataclass

from graphface.nodes.types.arrays import Albedo, Detail, FloatArray, Mask


@dataclass(frozen=True)
class BareSkin:
    """What a face would look like if its skin were even and wore nothing.

    Attributes:
        color: float32 H x W x 3 in the photo's encoding, above 0: smooth, with the photo's light.
        deviation: of chroma of the skin's own pixels from it, in natural logarithms, robust standard deviation.
        greasepaint: 0 to 1; 1 where hardly any of the face has a color that skin has, so that `color` is paint.
        colorful: 0 to 1; 0 for a black-and-white photo.
    """

    color: Albedo
    deviation: float
    greasepaint: float
    colorful: float


@dataclass(frozen=True)
class Paint:
    """A layer of makeup: photo = (1 - opacity) * skin * exp(departure) + opacity * `skin` * light * exp(departure).

    Where it is sheer it filters the light of the skin below, where it is opaque it has its own color on any skin.

    Attributes:
        opacity: float32 H x W, 0 to 1.
        departure: float32 H x W x 3, logarithm of painted over bare skin; 0 where nothing is worn.
        skin: float32 (3,), color of the wearer's bare skin in the middle of the photo's light, in the photo's encoding.
        greasepaint: 0 to 1; 1 where the layer covers a face that shows hardly any skin, and is meant for all of it.
    """

    opacity: Mask
    departure: Detail
    skin: FloatArray
    greasepaint: float = 0.0
