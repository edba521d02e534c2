"""The reference's detail in the input's colors."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.strips import by_strips
from graphface.nodes.types import (
    Albedo,
    DetailMap,
)


@node("transfer.recoloured")
def recoloured(
    detail: DetailMap, reference: Albedo, albedo: Albedo, *, floor: Annotated[float, Field(gt=0, le=1)] = 0.1
) -> DetailMap:
    """The reference's detail on the input's albedo: a wrinkle darkens the skin that it lies in.

    The additive map is rho (s - SH), so its color is the albedo's; taken as it is, the shadow of a red lip would leave
    a green one on pale skin. s - SH is read off the means of both over the channels, and what the two albedos differ by
    is moved along with it: equal albedos leave the map as it is, to the last bit, also where the floor is at work.

    Args:
        reference, albedo: the reference's, warped to the input, and the input's.
        floor: least mean albedo divided by.
    """
    offset = np.empty_like(detail.offset)
    pivot = None if detail.pivot is None else np.empty_like(detail.pivot)

    def strip(rows: slice) -> None:
        own, other = albedo[rows], reference[rows]
        least = np.maximum(channel_mean(other), np.float32(floor))
        moved = np.asarray(channel_mean(detail.offset[rows]) / least, np.float32)
        offset[rows] = detail.offset[rows] + (own - other) * in_three_channels(moved)
        if pivot is not None and detail.pivot is not None:
            lighter = np.asarray(channel_mean(own) / least, np.float32)
            pivot[rows] = np.asarray(detail.pivot[rows] * in_three_channels(lighter), np.float32)

    by_strips(strip, offset.shape)
    return replace(detail, offset=offset, pivot=pivot, ceiling=None)
