"""Weighted human disagreement rate."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Figure, node
from graphface.nodes.color import channel_mean
from graphface.nodes.types import Albedo, FloatArray, Judgements

_LEAST = 1e-10


@node("metrics.whdr")
def whdr(
    albedo: Albedo, judgements: Judgements, *, delta: Annotated[float, Field(gt=0, le=1)] = 0.1
) -> Annotated[float, Figure("lower")]:
    """Weighted human disagreement rate (Bell, Bala, Snavely 2014), 0 to 1; lower is better.

    Intrinsic Images in the Wild, SIGGRAPH 2014: how often the albedo contradicts which of two points people found
    darker.

    Args:
        albedo: H x W x 3; its mean over channels is compared.
        delta: two reflectances count as equal while their ratio is at most 1 + delta.

    Raises:
        ValueError: no judgement has a positive weight.
    """
    lightness = channel_mean(albedo)
    wrong = total = 0.0
    for judgement in judgements.pairs:
        first, second = (_at(lightness, point) for point in (judgement.first, judgement.second))
        darker = "1" if second / first > 1 + delta else "2" if first / second > 1 + delta else "E"
        wrong += judgement.weight * (darker != judgement.darker)
        total += judgement.weight
    if total <= 0:
        raise ValueError("no judgement has any weight")
    return wrong / total


def _at(lightness: FloatArray, point: tuple[float, float]) -> float:
    """The value at a point given in shares of width and height; above 0."""
    height, width = lightness.shape
    column, row = (min(int(np.clip(p, 0, 1) * n), n - 1) for p, n in zip(point, (width, height), strict=True))
    return max(float(lightness[row, column]), _LEAST)
