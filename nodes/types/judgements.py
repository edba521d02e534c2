"""What people said about which of two points of a picture is darker."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Judgement:
    """Two points (x, y in shares of width and height), which of them people found darker, and how sure they were."""

    first: tuple[float, float]
    second: tuple[float, float]
    darker: Literal["1", "2", "E"]
    weight: float = 1.0


@dataclass(frozen=True)
class Judgements:
    """What people said about one picture."""

    pairs: tuple[Judgement, ...]
