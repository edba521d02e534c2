"""A detail map in the colors of another albedo."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, DetailMap


@node("transfer.recolored", formerly=("transfer.recoloured",))
def recolored(
    detail: DetailMap, reference: Albedo, albedo: Albedo, *, floor: Annotated[float, Field(gt=0, le=1)] = 0.1
) -> DetailMap:
    """A detail map made on one albedo, as it would be on another: a wrinkle darkens the skin that it lies in.

    The additive map is I_d = rho (s - SH), so it has the albedo's color: unchanged, the shadow of a red lip would leave
    a green one on pale skin. s - SH is estimated as the channel mean of I_d over that of rho, and the difference of the
    two albedos times it is added. Equal albedos leave the map as it is, to the last bit, also below the floor.

    Args:
        detail: the map. reference: the albedo that it was made on, at the input's pixels. albedo: the new one.
        floor: least mean albedo that is divided by.
    """
    offset = np.empty_like(detail.offset)
    pivot = None if detail.pivot is None else np.empty_like(detail.pivot)

    def strip(rows: slice) -> None:
        new, old = albedo[rows], reference[rows]
        divisor = np.maximum(channel_mean(old), np.float32(floor))
        residual_shading = np.asarray(channel_mean(detail.offset[rows]) / divisor, np.float32)
        offset[rows] = detail.offset[rows] + (new - old) * in_three_channels(residual_shading)
        if pivot is not None and detail.pivot is not None:
            ratio = np.asarray(channel_mean(new) / divisor, np.float32)
            pivot[rows] = np.asarray(detail.pivot[rows] * in_three_channels(ratio), np.float32)

    by_strips(strip, offset.shape)
    return replace(detail, offset=offset, pivot=pivot, ceiling=None)
