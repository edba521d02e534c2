"""The painted face's albedo."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface import node
from graphface.nodes.makeup.tone import Tone
from graphface.nodes.types import Albedo, Features, FloatArray, Mask

_LEAST_ALBEDO = 0.05


@node("makeup.albedo")
def albedo(
    albedo: Albedo, reference: Albedo, mask: Mask, features: Features, *, tone: Tone = 1.0, eyes: Tone = 0.0
) -> Albedo:
    """rho(r) where makeup goes, rho(i) in the openings of eyes and mouth (paper: "for most regions of the face").

    Args:
        albedo: the input's. reference: the reference's, warped to the input.
        mask: the input's face, over which the skins' colors are compared.
        tone: share of the reference's skin color that comes along; at 0 only what differs from its skin does.
        eyes: how much the openings are painted as well (contact lenses).
    """
    opening = np.maximum(features.eyes, features.mouth)[..., None]
    if tone < 1:
        skin = _skin(mask, features)
        own, other = (_median(values, skin) for values in (albedo, reference))
        reference = reference * np.float32(own / np.maximum(other, _LEAST_ALBEDO)) ** np.float32(1 - tone)
    rows = np.flatnonzero(opening.any(axis=(1, 2)))
    painted = reference.copy()
    if rows.size:
        window = slice(rows[0], rows[-1] + 1)
        painted[window] += opening[window] * np.float32(1 - eyes) * (albedo[window] - reference[window])
    return painted


def _skin(mask: Mask, features: Features) -> NDArray[np.bool_]:
    """Bare skin: inside the face, off all its features."""
    skin: NDArray[np.bool_] = (mask > 0.5) & (features.any_of("eyes", "mouth", "lips", "lids", "brows") < 0.1)
    return skin


def _median(values: FloatArray, where: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Median color; grey where there is no pixel."""
    if not where.any():
        return np.ones(3, np.float32)
    return np.asarray(np.median(values[where][:: max(1, int(where.sum()) // 20000)], axis=0), np.float32)
