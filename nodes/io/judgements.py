"""Reading the judgements of *Intrinsic Images in the Wild*."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from graphface import UnreadableFile
from graphface.nodes.types import Judgement, Judgements


def read_judgements(path: Path) -> Judgements:
    """Read the JSON of *Intrinsic Images in the Wild*: `intrinsic_points` and `intrinsic_comparisons`.

    Undecided comparisons (no `darker`, no positive `darker_score`) are left out.

    Raises:
        UnreadableFile: the file is not JSON of that form.
    """
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
        points = {p["id"]: (float(p["x"]), float(p["y"])) for p in stored["intrinsic_points"]}
        return Judgements(tuple(_decided(stored["intrinsic_comparisons"], points)))
    except (OSError, ValueError, KeyError, TypeError) as error:
        reason = f"no judgements in the form of Intrinsic Images in the Wild ({type(error).__name__}: {error})"
        raise UnreadableFile(path, reason) from None


def _decided(comparisons: Iterable[dict[str, Any]], points: dict[Any, tuple[float, float]]) -> Iterable[Judgement]:
    for comparison in comparisons:
        weight, darker = comparison["darker_score"], comparison["darker"]
        if darker in ("1", "2", "E") and weight is not None and weight > 0:
            yield Judgement(points[comparison["point1"]], points[comparison["point2"]], darker, float(weight))
