"""Which pixels take how much of the reference's detail."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.types import REGIONS, Correspondence, Features, Mask, Regions

if TYPE_CHECKING:
    Region = str
else:
    Region = Literal[REGIONS]  # a type checker cannot read names that are written only once


Strength = Annotated[float, Field(ge=0, le=2)]


@node("transfer.mask")
def mask(
    regions: Regions,
    correspondence: Correspondence | None = None,
    features: Features | None = None,
    skin: Mask | None = None,
    given: Mask | None = None,
    paint: Mask | None = None,
    *,
    take: tuple[Region, ...] = REGIONS,
    strength: Strength = 1.0,
    strengths: dict[Region, Strength] = {},  # noqa: B006 - pydantic copies it
    openings: Strength = 0.0,
    painted: Strength = 0.0,
) -> Mask:
    """How much of the reference's detail each pixel takes, H x W, 0 to 2.

    Args:
        regions: the input's. correspondence: where the reference does not show a point the input's detail stays.
        features: the input's; `openings` is the strength inside the openings of eyes and mouth (a gaze and teeth are
            no detail of skin).
        skin: where the input's detail may be changed; hair in front of the face is not skin.
        given: a user's own mask, multiplied on top.
        paint: where the reference wears makeup, of `transfer.paint`; `painted` is the strength there.
        take: the regions that are transferred; with none the photo does not change. Left and right are the person's.
        strength: of all regions. strengths: of single regions, instead. Above 1 detail is exaggerated.
    """
    if not take:
        warn("transfer.mask: no region was asked for; the photo stays as it is")
    total = np.zeros_like(regions.nose)
    for name in dict.fromkeys(take):
        total += getattr(regions, name) * np.float32(strengths.get(name, strength))
    if correspondence is not None:
        total *= correspondence.known * correspondence.inside
    if features is not None:
        total *= 1 - features.openings * np.float32(1 - min(openings, 1))
    if paint is not None:
        total *= 1 - paint * np.float32(1 - min(painted, 1))
    for factor in (skin, given):
        if factor is not None:
            total *= np.clip(factor, 0, 1)
    return total
