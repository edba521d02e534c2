"""Whether the parts of a value belong together: what the types' `flaw` is made of."""

from __future__ import annotations

from collections.abc import Mapping
from operator import attrgetter
from typing import Any

from numpy.typing import NDArray


def mismatch(value: object, shapes: Mapping[str, str]) -> str | None:
    """The first part whose shape is not as it has to be, in a sentence; None where all agree.

    Args:
        shapes: path of a part (None is skipped) to its axes: numbers, letters that mean the same length wherever they
            stand, and at the end "..." for any further axes.

    >>> from types import SimpleNamespace
    >>> import numpy as np
    >>> mismatch(SimpleNamespace(a=np.zeros((2, 3)), b=np.zeros(4)), {"a": "N 3", "b": "N"})
    "b has the shape (4,), expected (N) with N = 2 as in 'a'"
    """
    lengths: dict[str, tuple[int, str]] = {}
    for path, axes in shapes.items():
        part = attrgetter(path)(value)
        if part is None:
            continue
        words = axes.split()
        shape = tuple(part.shape)
        if words[-1] == "...":
            words = words[:-1]
            shape = shape[: len(words)]
        fits = len(words) == len(shape)
        for word, length in zip(words, shape, strict=False):
            wanted = int(word) if word.isdigit() else lengths.setdefault(word, (length, path))[0]
            fits = fits and wanted == length
        if not fits:
            known = [
                f"{w} = {lengths[w][0]} as in {lengths[w][1]!r}" for w in words if lengths.get(w, ("", path))[1] != path
            ]
            given = f" with {', '.join(known)}" if known else ""
            return f"{path} has the shape {tuple(part.shape)}, expected ({', '.join(axes.split())}){given}"
    return None


REACH = 1e7
"""Pixels. What lies farther from a picture is no geometry: its squares and products leave float32."""


def too_far(name: str, places: NDArray[Any]) -> str | None:
    """That a coordinate is farther away than `REACH`, in a sentence; None where all are nearer."""
    if not places.size:
        return None
    farthest = float(abs(places).max())
    return f"{name} reaches {farthest:.3g}, farther than {REACH:g} pixels" if farthest > REACH else None


def out_of_range(name: str, indices: NDArray[Any] | None, count: int, *, none: bool = False) -> str | None:
    """That an index points outside of what it counts, in a sentence; None where all are in 0..count-1.

    Args:
        none: -1 is allowed too: there is none.
    """
    if indices is None or not indices.size:
        return None
    low, high = int(indices.min()), int(indices.max())
    first = -1 if none else 0
    if low >= first and high < count:
        return None
    return f"{name} has indices from {low} to {high}, allowed are {first} to {count - 1}"
