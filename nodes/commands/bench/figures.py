"""Figures as the cells of a table, and as a CSV file."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any


def mean_of(figures: Iterable[float | None], digits: int) -> str:
    """Mean of those that are known; nothing where none is."""
    from statistics import fmean

    known = [figure for figure in figures if figure is not None]
    return f"{fmean(known):.{digits}f}" if known else ""


def time_beside(milliseconds: float, first: float) -> tuple[str, str]:
    """CPU milliseconds, and how many times those of the first row they are."""
    return f"{milliseconds:.1f}", f"{milliseconds / max(first, 1e-6):.2f}"


TIME_HEADERS = (">CPU ms", ">x first")
"""Of the cells of `time_beside`."""


def write_csv(figures: Sequence[Any], path: Path | None) -> None:
    """One line for each figure, a dataclass; nothing without a path."""
    if path is None or not figures:
        return
    from csv import DictWriter
    from dataclasses import asdict

    with path.open("w", newline="", encoding="utf-8") as file:
        writer = DictWriter(file, list(asdict(figures[0])))
        writer.writeheader()
        writer.writerows(asdict(figure) for figure in figures)
