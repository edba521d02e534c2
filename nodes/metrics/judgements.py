"""WHDR: how often an albedo contradicts what people said about which of two points is darker."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from graphface.nodes.color import channel_mean
from graphface.nodes.types import Albedo, Judgement

_LEAST = 1e-10


def whdr(albedo: Albedo, judgements: Iterable[Judgement], *, delta: float = 0.1) -> float:
    """Weighted human disagreement rate, 0 to 1 (Bell, Bala, Snavely 2014, section 4.3).

    Args:
        albedo: H x W x 3; its mean over channels is compared.
        delta: ratio, beyond 1, above which two reflectances count as different.

    Raises:
        ValueError: no judgement has any weight.
    """
    lightness = channel_mean(albedo)
    wrong = total = 0.0
    for judgement in judgements:
        one, other = (_at(lightness, point) for point in (judgement.first, judgement.second))
        said = "1" if other / max(one, _LEAST) > 1 + delta else "2" if one / max(other, _LEAST) > 1 + delta else "E"
        wrong += judgement.weight * (said != judgement.darker)
        total += judgement.weight
    if total <= 0:
        raise ValueError("no judgement has any weight")
    return wrong / total


def _at(lightness: np.ndarray[tuple[int, ...], np.dtype[np.float32]], point: tuple[float, float]) -> float:
    height, width = lightness.shape
    column, row = (min(int(np.clip(p, 0, 1) * n), n - 1) for p, n in zip(point, (width, height), strict=True))
    return max(float(lightness[row, column]), _LEAST)
