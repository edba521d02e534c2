"""Files of correspondences that were set by hand."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from graphface import UnreadableFile
from graphface.nodes.types import Pins


def read_pins(path: Path) -> Pins:
    """Read a text file with four numbers a line; commas, spaces, empty lines and # comments may be used.

    Raises:
        UnreadableFile: a line does not hold four finite numbers, or the file cannot be read.
    """
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise UnreadableFile(path, str(error)) from None
    rows: list[list[float]] = []
    for number, line in enumerate(lines, 1):
        words = line.partition("#")[0].replace(",", " ").split()
        if words:
            rows.append(_four_numbers(words, path, number))
    return Pins(np.asarray(rows, np.float32).reshape(-1, 4))


def _four_numbers(words: list[str], path: Path, line: int) -> list[float]:
    try:
        row = [float(word) for word in words]
    except ValueError:
        row = []
    if len(row) != 4 or not np.isfinite(row).all():
        raise UnreadableFile(path, f"line {line}: expected four numbers (x y in the input, x y in the reference)")
    return row
