"""The albedo of the painted face."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.makeup.tone import Tone
from graphface.nodes.types import Albedo, Features, FloatArray, Mask

_LEAST_ALBEDO = 0.05


_LARGEST_SAMPLE = 20000
"""Pixels that the median color of skin is computed from, about."""


@node("makeup.albedo")
def albedo(
    albedo: Albedo,
    reference: Albedo,
    mask: Mask,
    features: Features,
    *,
    tone: Tone = 1.0,
    openings: Annotated[float, Field(ge=0, le=1), Formerly("eyes")] = 0.0,
) -> Albedo:
    """The reference's albedo rho^(r) in place of the input's rho^(i), except in the openings of eyes and mouth.

    Paper: "we need to replace input image albedo with reference albedo for most regions of the face".

    Args:
        albedo: rho^(i). reference: rho^(r), warped to the input.
        mask: the input's face, in which the colors of the two skins are compared.
        tone: share of the difference in skin color that is transferred. At 0 the input's skin keeps its color, and only
            the reference's deviations from its own skin color are transferred.
        openings: share of the reference's albedo in the openings (contact lenses).
    """
    if tone < 1:
        skin = _skin(mask, features)
        of_input, of_reference = (_median_color(values, skin) for values in (albedo, reference))
        ratio = np.float32(of_input / np.maximum(of_reference, _LEAST_ALBEDO))
        reference = reference * ratio ** np.float32(1 - tone)
    painted = reference.copy()
    opening = features.openings
    box = bounding_box(opening)
    if box is not None:
        weight = opening[box][..., None] * np.float32(1 - openings)
        painted[box] += weight * (albedo[box] - reference[box])
    return painted


def _skin(mask: Mask, features: Features) -> NDArray[np.bool_]:
    """Pixels inside the face that belong to none of its features."""
    skin: NDArray[np.bool_] = (mask > 0.5) & (features.any_of("eyes", "mouth", "lips", "lids", "brows") < 0.1)
    return skin


def _median_color(values: FloatArray, where: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Median of each channel; white where there is no pixel."""
    if not where.any():
        return np.ones(3, np.float32)
    step = max(1, int(where.sum()) // _LARGEST_SAMPLE)
    return np.asarray(np.median(values[where][::step], axis=0), np.float32)
