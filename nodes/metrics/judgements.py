"""WHDR: how often an albedo contradicts what people said about which of two points is darker."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from graphface import UnreadableFile
from graphface.nodes.colour import channel_mean
from graphface.nodes.types import Albedo

_LEAST = 1e-10


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

    @classmethod
    def from_file(cls, path: Path) -> Judgements:
        """Read the JSON of *Intrinsic Images in the Wild*: `intrinsic_points` and `intrinsic_comparisons`.

        Comparisons that people did not settle (no `darker`, no positive `darker_score`) are left out.

        Raises:
            UnreadableFile: the file is not JSON of that form.
        """
        try:
            stored = json.loads(path.read_text(encoding="utf-8"))
            places = {p["id"]: (float(p["x"]), float(p["y"])) for p in stored["intrinsic_points"]}
            return cls(tuple(_settled(stored["intrinsic_comparisons"], places)))
        except (OSError, ValueError, KeyError, TypeError) as error:
            reason = f"no judgements in the form of Intrinsic Images in the Wild ({type(error).__name__}: {error})"
            raise UnreadableFile(path, reason) from None


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


def _settled(comparisons: Iterable[dict[str, Any]], places: dict[Any, tuple[float, float]]) -> Iterable[Judgement]:
    for said in comparisons:
        weight = said["darker_score"]
        if said["darker"] in ("1", "2", "E") and weight is not None and weight > 0:
            yield Judgement(places[said["point1"]], places[said["point2"]], said["darker"], float(weight))
