"""Human judgements about which of two points of a picture is darker."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Judgement:
    """One comparison.

    Attributes:
        first, second: (x, y) in shares of width and height, 0..1.
        darker: the point that people found darker, "1" or "2"; "E" if they found both equal.
        weight: their confidence, above 0.
    """

    first: tuple[float, float]
    second: tuple[float, float]
    darker: Literal["1", "2", "E"]
    weight: float = 1.0


@dataclass(frozen=True)
class Judgements:
    """All comparisons of one picture."""

    pairs: tuple[Judgement, ...]
