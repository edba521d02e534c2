"""Values made immutable, measured, checked and described, mostly as they leave a node.

A walk over a value (`graphface.values.parts`) finds its arrays; they become read-only, so that a memoized value cannot
be edited behind the cache's back, and each distinct buffer is counted once. Scalars, by far the most common value in
large graphs of small nodes, leave on the first line.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Callable, Iterator, MutableMapping
from itertools import islice
from typing import Any

import numpy as np

from graphface.values.parts import SCALARS, Named, rule_of


def arrays_in(value: Any) -> Iterator[tuple[str, np.ndarray]]:
    """Every array in a value with the path to it ("", "albedo", "lights[0].color")."""
    for path, array in _walk(value):
        yield path.removeprefix("."), array


def _walk(value: Any) -> Iterator[tuple[str, np.ndarray]]:
    """The arrays of a value with the steps to them ("", ".albedo", "[0].color")."""
    if isinstance(value, np.ndarray):
        yield "", value
        return
    rule = rule_of(type(value))
    if rule is None:
        return
    for label, part in rule.items(value):
        kind = type(part)
        if kind is np.ndarray:
            yield rule.step(label), part
        elif kind not in SCALARS:
            for path, array in _walk(part):
                yield rule.step(label) + path, array


def with_arrays(value: Any, change: Callable[[np.ndarray], np.ndarray]) -> Any:
    """The same value with `change(array)` in place of every array; what holds no array is the same object."""
    if isinstance(value, np.ndarray):
        return change(value)
    rule = rule_of(type(value))
    if rule is None:
        return value
    parts = [part for _, part in rule.items(value)]
    changed = [with_arrays(part, change) for part in parts]
    same = all(new is old for new, old in zip(changed, parts, strict=True))
    return value if same else rule.like(value, changed)


def freeze(value: Any) -> tuple[np.ndarray, ...]:
    """Make every array of a value read-only; the buffers they live in, each once."""
    if type(value) in SCALARS:
        return ()
    roots: dict[int, np.ndarray] = {}
    for _, array in _walk(value):
        root = buffer_of(array)
        roots[id(root)] = root
        array.flags.writeable = False
        if root is not array:
            root.flags.writeable = False
    return tuple(roots.values())


def buffer_of(array: np.ndarray) -> np.ndarray:
    """The array that owns the memory of a view."""
    while isinstance(array.base, np.ndarray):
        array = array.base
    return array


def first_non_finite(value: Any, known: MutableMapping[int, weakref.ref[Any]]) -> str | None:
    """Where a value holds NaN or infinity: how many, and the first index; None where it holds none.

    Args:
        known: arrays found finite before, by id, as long as they live; extended by those found now.
    """
    kind = type(value)
    if kind is float:
        return None if math.isfinite(value) else f"is {value}"
    if kind in SCALARS:
        return None
    if isinstance(value, np.inexact):
        return None if np.isfinite(value) else f"is {value}"
    for path, array in _walk(value):
        if array.dtype.kind not in "fc" or array.size == 0:
            continue
        seen = known.get(id(array))
        if seen is not None and seen() is array:
            continue
        if is_finite(array):
            key = id(array)
            known[key] = weakref.ref(array, lambda _, key=key: known.pop(key, None))  # type: ignore[misc]
            continue
        bad = ~np.isfinite(array)
        index = tuple(int(i) for i in np.argwhere(bad)[0])
        where = f"the first ({array[index]}) at {list(index)}"
        return f"{path} has {int(bad.sum())} non-finite of {array.size} values, {where}"
    return None


def is_finite(array: np.ndarray) -> bool:
    """Whether an array has no NaN and no infinity, without a temporary of its size: minimum and maximum carry both."""
    if array.dtype.kind == "c":
        return bool(np.isfinite(array).all())
    return bool(np.isfinite(array.min()) and np.isfinite(array.max()))


def describe(value: Any, range_of: Callable[[np.ndarray], tuple[Any, Any]] | None = None) -> str:
    """A value in one short line: shape, dtype and range of an array, the parts of what has any.

    Args:
        range_of: the smallest and the largest number of an array, where they are known already.
    """
    if isinstance(value, np.ndarray):
        return _describe_array(value, range_of or _finite_range)
    rule, name = rule_of(type(value)), type(value).__name__
    if isinstance(rule, Named):
        return f"{name}({', '.join(f'{label}={describe(part, range_of)}' for label, part in rule.items(value))})"
    if rule is not None:
        first = "".join(f": {describe(part, range_of)}, ..." for _, part in islice(rule.items(value), 1))
        return f"{name} of {len(value)}{first}"
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _describe_array(array: np.ndarray, range_of: Callable[[np.ndarray], tuple[Any, Any]]) -> str:
    text = f"{array.dtype}{list(array.shape)}"
    if array.size and array.dtype.kind in "fiub":
        low, high = range_of(array)
        text += f" {low:.4g}..{high:.4g}"
    return text


def _finite_range(array: np.ndarray) -> tuple[Any, Any]:
    finite = bool(np.isfinite(array).any())
    with np.errstate(invalid="ignore"):
        return (np.nanmin(array), np.nanmax(array)) if finite else (np.nan, np.nan)
