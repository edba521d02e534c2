"""Values made immutable, measured and checked as they leave a node.

One walk over a value finds its arrays; they become read-only, so that a memoized value cannot be edited behind the
cache's back, and each distinct buffer is counted once. Scalars, by far the most common value in large graphs of small
nodes, leave on the first line.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any

import numpy as np

_SCALARS = frozenset((int, bool, str, bytes, type(None)))


def arrays_in(value: Any) -> Iterator[tuple[str, np.ndarray]]:
    """Every array in a value with the path to it ("", "albedo", "lights[0].color")."""
    kind = type(value)
    if kind in _SCALARS or kind is float:
        return
    if isinstance(value, np.ndarray):
        yield "", value
    elif is_dataclass(kind):
        for name in field_names(kind):
            for path, array in arrays_in(getattr(value, name)):
                yield f"{name}.{path}".rstrip("."), array
    elif isinstance(value, list | tuple):
        for index, item in enumerate(value):
            for path, array in arrays_in(item):
                yield f"[{index}].{path}".rstrip("."), array
    elif isinstance(value, Mapping):
        for key, item in value.items():
            for path, array in arrays_in(item):
                yield f"{key}.{path}".rstrip("."), array


def freeze(value: Any, lent: frozenset[int] | set[int] = frozenset()) -> tuple[np.ndarray, ...]:
    """Make every array of a value read-only; the buffers they live in, each once.

    Buffers whose id is in `lent` belong to the caller and keep their flags (views of them are made read-only).
    """
    kind = type(value)
    if kind in _SCALARS or kind is float:
        return ()
    roots: dict[int, np.ndarray] = {}
    for _, array in arrays_in(value):
        root = buffer_of(array)
        roots[id(root)] = root
        if id(array) not in lent:
            array.flags.writeable = False
        if root is not array and id(root) not in lent:
            root.flags.writeable = False
    return tuple(roots.values())


def buffer_of(array: np.ndarray) -> np.ndarray:
    """The array that owns the memory of a view."""
    while isinstance(array.base, np.ndarray):
        array = array.base
    return array


def first_non_finite(value: Any, known: dict[int, weakref.ref[Any]]) -> str | None:
    """Where a value holds NaN or infinity: how many, and the first index; None where it holds none.

    Args:
        known: arrays found finite before, by id (held weakly: an id may be given again); extended by those found now.
    """
    kind = type(value)
    if kind is float:
        return None if math.isfinite(value) else f"is {value}"
    if kind in _SCALARS:
        return None
    if isinstance(value, np.inexact):
        return None if np.isfinite(value) else f"is {value}"
    for path, array in arrays_in(value):
        if array.dtype.kind not in "fc" or array.size == 0:
            continue
        seen = known.get(id(array))
        if seen is not None and seen() is array:
            continue
        if is_finite(array):
            known[id(array)] = weakref.ref(array)
            continue
        bad = ~np.isfinite(array)
        index = tuple(int(i) for i in np.argwhere(bad)[0])
        name = f".{path}" if path else ""
        where = f"the first ({array[index]}) at {list(index)}"
        return f"{name} has {int(bad.sum())} non-finite of {array.size} values, {where}"
    return None


def is_finite(array: np.ndarray) -> bool:
    """Whether an array has no NaN and no infinity, without a temporary of its size: minimum and maximum carry both."""
    if array.dtype.kind == "c":
        return bool(np.isfinite(array).all())
    return bool(np.isfinite(array.min()) and np.isfinite(array.max()))


@cache
def field_names(kind: type) -> tuple[str, ...]:
    return tuple(f.name for f in fields(kind))


def describe(value: Any) -> str:
    """A value in one short line: shape, dtype and range of an array, the fields of a dataclass."""
    if isinstance(value, np.ndarray):
        text = f"{value.dtype}{list(value.shape)}"
        if value.size and value.dtype.kind in "fiub":
            with np.errstate(invalid="ignore"):
                low, high = (
                    np.nanmin(value) if np.isfinite(value).any() else np.nan,
                    np.nanmax(value) if np.isfinite(value).any() else np.nan,
                )
            text += f" {low:.4g}..{high:.4g}"
        return text
    if is_dataclass(value) and not isinstance(value, type):
        parts = ", ".join(f"{n}={describe(getattr(value, n))}" for n in field_names(type(value)))
        return f"{type(value).__name__}({parts})"
    if isinstance(value, list | tuple):
        return f"{type(value).__name__} of {len(value)}" + (f": {describe(value[0])}, ..." if value else "")
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
