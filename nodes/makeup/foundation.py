"""Foundation: the photo's skin moved a little towards that of the reference, on face, ears and neck alike."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import in_three_channels, lab
from graphface.nodes.makeup.bare_skin import bare_color
from graphface.nodes.strips import by_strips
from graphface.nodes.types import BareSkin, Features, FloatArray, Image, Mask, Paint, Surface


@node("makeup.foundation")
def foundation(
    photo: Image,
    bare: BareSkin,
    paint: Paint,
    skin: Mask,
    surface: Surface,
    features: Features,
    *,
    strength: Annotated[float, Field(ge=0, le=1)] = 0.0,
    bound: Annotated[float, Field(ge=0, le=100)] = 9.0,
) -> Image:
    """The photo with all of its skin multiplied by one color.

    How much of a reference's skin is foundation a picture does not tell, so it is asked for. A shift beyond about 9 in
    CIE Lab looks like a mask, or like another person.

    Args:
        bare: the photo's own skin. paint: the reference's layer; of greasepaint no foundation is taken.
        skin: what is shifted: with ears and neck. Openings of eyes and mouth, lips and brows stay.
        strength: share of the difference between the two skins. bound: the largest shift, CIE76.
    """
    share = strength * (1 - paint.greasepaint) * bare.colorful
    if share == 0 or not (surface.coverage > 0.5).any():
        return photo
    own = bare_color(bare, surface)
    factor = np.asarray(_shifted(own, paint.skin, share, bound) / np.maximum(own, 0.02), np.float32)
    kept = np.minimum(features.any_of("eyes", "mouth", "lips", "brows"), 1)
    pixels = np.empty_like(photo.pixels)

    def strip(rows: slice) -> None:
        amount = in_three_channels(np.asarray(skin[rows] * (1 - kept[rows]), np.float32))
        pixels[rows] = np.where(
            amount > 0, np.clip(photo.pixels[rows] * (1 + amount * (factor - 1)), 0, 1), photo.pixels[rows]
        )

    by_strips(strip, pixels.shape)
    return photo.with_pixels(pixels)


def _shifted(own: FloatArray, other: FloatArray, share: float, bound: float) -> FloatArray:
    """A color moved towards another one by a share of their distance in CIE Lab, at most by the bound."""
    import cv2

    before, after = lab(np.stack([own, other])[None])[0]
    step = share * (after - before)
    step *= min(1.0, bound / max(float(np.linalg.norm(step)), 1e-6))
    return np.asarray(cv2.cvtColor((before + step)[None, None].astype(np.float32), cv2.COLOR_Lab2RGB)[0, 0], np.float32)
