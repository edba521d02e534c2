"""How much of the reference's skin comes with its makeup: colour by the albedo, lightness by the shading.

Where shading is intensity, albedo has no lightness, and the light fitted to a dark face is a dim one. So the tone that
a person's skin has is in two places, and both are moved by the same parameter.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.colour import channel_mean
from graphface.nodes.detail.rendering import rendering
from graphface.nodes.makeup.features import Features
from graphface.nodes.types import Albedo, DetailMap, FloatArray, Image, Mask, Shading

Tone = Annotated[float, Field(ge=0, le=1)]

_LEAST_LIGHT = 0.02
_LEAST_ALBEDO = 0.05
_MOST_RATIO = 8.0


@node("makeup.albedo")
def albedo(
    albedo: Albedo, reference: Albedo, mask: Mask, features: Features, *, tone: Tone = 1.0, eyes: Tone = 0.0
) -> Albedo:
    """rho(r) where makeup goes, rho(i) in the openings of eyes and mouth (paper: "for most regions of the face").

    Args:
        albedo: the input's. reference: the reference's, warped to the input.
        mask: the input's face, over which the skins' colours are compared.
        tone: share of the reference's skin colour that comes along; at 0 only what differs from its skin does.
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


@node("makeup.shading")
def shading(
    shading: Shading, estimated: Shading, reference: Shading, mask: Mask, features: Features, *, tone: Tone = 1.0
) -> Shading:
    """The light that the painted face is rendered under: `shading`, as much brighter as the reference's skin is.

    The openings of eyes and mouth are no skin, and keep the light they have.

    Args:
        shading: the input's own, spread over the picture, or that of a new scene.
        estimated: the input's own. reference: the reference's, warped to the input. mask: where they are compared.
        tone: share of the difference in lightness that is taken over.
    """
    opening = np.maximum(features.eyes, features.mouth)
    factor = 1 + np.float32(lightness(estimated, reference, mask) ** tone - 1) * (1 - opening)
    return shading * factor.reshape(*mask.shape, *[1] * (shading.ndim - 2))


@node("makeup.rendered")
def rendered(photo: Image, albedo: Albedo, shading: Shading) -> Image:
    """render(rho, F, theta): the painted face before its details, in the photo's encoding and file format."""
    return photo.with_pixels(np.clip(rendering(albedo, shading), 0, 1))


@node("makeup.exposed")
def exposed(detail: DetailMap, estimated: Shading, reference: Shading, mask: Mask, *, tone: Tone = 1.0) -> DetailMap:
    """The reference's detail map, as strong as it is under the light that `makeup.shading` gives.

    What the reference's skin shows in its own exposure is scaled with the lightness that it is rendered in.
    """
    if tone == 1:
        return detail
    factor = np.float32(lightness(estimated, reference, mask) ** (tone - 1))
    pivot = None if detail.pivot is None else detail.pivot * factor
    return replace(detail, offset=detail.offset * factor, pivot=pivot, ceiling=None)


def lightness(estimated: Shading, reference: Shading, mask: Mask) -> float:
    """Mean shading of the reference over that of the input, within 1/8 and 8; 1 where there is nothing to compare."""
    total = float(mask.sum(dtype=np.float64))
    if total < 1e-6:
        warn("makeup: the face mask is empty; the lightness of the two skins is taken as equal")
        return 1.0
    own, other = (
        float(np.einsum("hw,hw->", channel_mean(v), mask, dtype=np.float64)) / total for v in (estimated, reference)
    )
    return float(np.clip(max(other, _LEAST_LIGHT) / max(own, _LEAST_LIGHT), 1 / _MOST_RATIO, _MOST_RATIO))


def _skin(mask: Mask, features: Features) -> NDArray[np.bool_]:
    """Bare skin: inside the face, off all its features."""
    skin: NDArray[np.bool_] = (mask > 0.5) & (features.any_of("eyes", "mouth", "lips", "lids", "brows") < 0.1)
    return skin


def _median(values: FloatArray, where: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Median colour; grey where there is no pixel."""
    if not where.any():
        return np.ones(3, np.float32)
    return np.asarray(np.median(values[where][:: max(1, int(where.sum()) // 20000)], axis=0), np.float32)
