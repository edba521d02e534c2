"""Figures as people say them: 28.9 dB, 0.84, 1.2 s; and which of them is the best."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

_TENTHS = frozenset(("dB", "°"))
"""Units in which a tenth is as much as anybody can tell."""
_MOST_DECIMALS = 6


def rounded(values: Sequence[float | None], unit: str = "") -> list[str]:
    """A column of figures with one number of decimals; "" for None.

    Decibels and degrees have one decimal, other figures so many that the smallest shows two digits; up to two more
    where two different figures among the values would else read the same.
    """
    finite = [v for v in values if v is not None and math.isfinite(v)]
    decimals = 1 if unit in _TENTHS else _two_digits(finite)
    for more in range(3):
        texts = [_fixed(v, decimals + more) for v in finite]
        if len(set(texts)) == len(set(finite)):
            decimals += more
            break
    space = "" if unit in ("", "°") else " "
    return ["" if v is None else f"{_fixed(v, decimals)}{space}{unit}" for v in values]


def duration(seconds: float) -> str:
    """Two digits of milliseconds or seconds: 0.4 ms, 34 ms, 340 ms, 1.2 s, 75 s."""
    two = float(f"{seconds:.2g}")
    if two >= 100:
        return f"{seconds:.0f} s"
    return f"{two:g} s" if two >= 1 else f"{float(f'{two * 1e3:.2g}'):g} ms"


def best(values: Sequence[float | None], better: Literal["higher", "lower"] | None) -> set[int]:
    """Where the best values stand; nowhere where all are alike, or where nobody says what is better."""
    known = [v for v in values if v is not None and not math.isnan(v)]
    if better is None or len(set(known)) < 2:
        return set()
    target = max(known) if better == "higher" else min(known)
    return {place for place, value in enumerate(values) if value == target}


def _two_digits(values: Sequence[float]) -> int:
    """Decimals with which the smallest of the values shows two digits."""
    smallest = min((abs(v) for v in values if v), default=1.0)
    return max(0, min(_MOST_DECIMALS, 1 - math.floor(math.log10(smallest))))


def _fixed(value: float, decimals: int) -> str:
    return f"{value:.{decimals}f}" if math.isfinite(value) else str(value)
