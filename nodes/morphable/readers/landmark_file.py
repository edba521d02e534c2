"""Vertices of the 68 iBUG points from a text file."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile

_LINE = re.compile(r"^\s*(\d+)\s*=\s*(\d+)\s*(#.*)?$")


def read_landmark_numbers(path: Path) -> NDArray[np.int32]:
    """Vertices (68,) of lines "ibug number (from 1) = vertex", as in eos's mappings; -1 where there is no line.

    Raises:
        UnreadableFile: no such line, or numbers beyond 68.
    """
    found = np.full(68, -1, np.int32)
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError) as error:
        raise UnreadableFile(path, str(error)) from error
    for place, line in enumerate(lines, start=1):
        match = _LINE.match(line)
        if match is None:
            continue
        point, vertex = int(match[1]), int(match[2])
        if not 1 <= point <= 68:
            raise UnreadableFile(path, f"line {place}: there is no iBUG point {point}")
        found[point - 1] = vertex
    if (found < 0).all():
        raise UnreadableFile(path, 'has no line of the form "37 = 2088" (iBUG point = vertex)')
    return found
