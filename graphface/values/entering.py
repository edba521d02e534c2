"""The seam: what enters a run from outside (files, arrays, values built in Python) is checked once, by its type.

What nodes hand to each other is trusted. A type says what its values have to be:

- an `ArrayType` by its shape and kind, and by `dtype`, which what enters is converted to; with `bounded`, values
  outside of `low` and `high` are refused;
- a dataclass by the annotations of its fields, and by a method `flaw()` that returns a sentence, or None where its
  parts belong together (shapes, ranges of indices).

Arrays of declared types are brought to the byte order of the machine; NaN and infinity are refused where a dtype is
declared. An array of which nothing is declared (a port of `Any`) stays as it is.
"""

from __future__ import annotations

import typing
from typing import Any

import numpy as np

from graphface.values.parts import SCALARS, Named, rule_of
from graphface.values.port_types import ArrayType, ListOf, PortType, array_of, spelled_out


def entered(value: Any, declared: PortType) -> Any:
    """A value as it may enter a run: the same object where nothing had to be converted.

    Args:
        value: of the declared type, or an array that can be converted to it.

    Raises:
        ValueError: what is wrong with it, and in which of its parts.
    """
    for atom in declared.alternatives:
        if isinstance(atom, ArrayType) and isinstance(value, np.ndarray):
            return _array_of_type(value, atom, "")
        if isinstance(atom, ListOf) and isinstance(value, list | tuple):
            return [entered(item, atom.item) for item in value]
    return _part(value, None, "")


def _part(value: Any, annotation: Any, where: str) -> Any:
    """A value below another: `annotation` is what is declared of it, None where nothing is."""
    if type(value) in SCALARS:
        return value
    if isinstance(value, np.ndarray):
        return _array(value, annotation, where)
    rule = rule_of(type(value))
    if rule is None:
        return value
    hints = rule.annotations(type(value)) if isinstance(rule, Named) else {}
    parts = [(label, part, where + rule.step(label)) for label, part in rule.items(value)]
    changed = [_part(part, hints.get(label), at) for label, part, at in parts]
    if any(new is not old for new, (_, old, _) in zip(changed, parts, strict=True)):
        value = rule.like(value, changed)
    _check_together(value, where)
    return value


def _check_together(value: Any, where: str) -> None:
    flaw = getattr(type(value), "flaw", None)
    if not callable(flaw):
        return
    try:
        found = flaw(value)
    except (ValueError, IndexError, TypeError, AttributeError) as error:
        found = f"its parts do not belong together ({type(error).__name__}: {error})"
    if found:
        raise ValueError(_at(where, found))


def _array(array: Any, annotation: Any, where: str) -> Any:
    for choice in _choices(annotation):
        atom = array_of(choice)
        if atom is not None:
            return _array_of_type(array, atom, where)
        dtype = _declared_dtype(choice)
        if dtype is not None:
            return _finite(_converted(array, dtype, where), where)
    return array


def _array_of_type(array: Any, atom: ArrayType, where: str) -> Any:
    array = _native(array)
    if atom.dtype is not None:
        if atom.bounded and array.dtype.kind in "bu" and atom.kind == "f":
            array = np.divide(array, 1 if array.dtype.kind == "b" else np.iinfo(array.dtype).max, dtype=atom.dtype)
        array = _converted(array, np.dtype(atom.dtype), where)
    problem = atom.problem(array)
    if problem is not None:
        raise ValueError(_at(where, problem))
    if atom.dtype is not None:
        _finite(array, where)
    if atom.bounded and array.size:
        low, high = float(array.min()), float(array.max())
        if (atom.low is not None and low < atom.low - _SLACK) or (atom.high is not None and high > atom.high + _SLACK):
            text = f"a {atom.name} lies within {atom.low:g} and {atom.high:g}, this one within {low:.4g} and {high:.4g}"
            raise ValueError(_at(where, text))
    return array


_SLACK = 1e-3
"""How far rounding may lead out of a range."""


def _finite(array: Any, where: str) -> Any:
    if array.dtype.kind in "fc" and array.size and not np.isfinite(array).all():
        raise ValueError(_at(where, "has values that are not numbers (NaN or infinite)"))
    return array


def _native(array: Any) -> Any:
    return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))


def _converted(array: Any, dtype: np.dtype[Any], where: str) -> Any:
    if array.dtype == dtype:
        return _native(array)
    if array.dtype.kind == "f" and dtype.kind == "f":
        with np.errstate(over="ignore"):  # what becomes infinite is refused as such
            return array.astype(dtype)
    if array.dtype.kind in "iu" and dtype.kind in "iu":
        range_of = np.iinfo(dtype)
        if not array.size or (array.min() >= range_of.min and array.max() <= range_of.max):
            return array.astype(dtype)
    raise ValueError(_at(where, f"expected {dtype}, got {array.dtype}"))


def _choices(annotation: Any) -> list[Any]:
    """The members of a union, aliases spelled out; nothing of None."""
    if annotation is None:
        return []
    annotation = spelled_out(annotation)
    if typing.get_origin(annotation) is not None and array_of(annotation) is None and _is_union(annotation):
        return [choice for member in typing.get_args(annotation) for choice in _choices(member)]
    return [annotation]


def _is_union(annotation: Any) -> bool:
    import types

    return typing.get_origin(annotation) in (typing.Union, types.UnionType)


def _declared_dtype(annotation: Any) -> np.dtype[Any] | None:
    """float32 of NDArray[np.float32]; None of another annotation, or where it names a family of dtypes."""
    if typing.get_origin(annotation) is not np.ndarray:
        return None
    (kind,) = typing.get_args(typing.get_args(annotation)[1]) or (None,)
    try:
        return np.dtype(kind) if isinstance(kind, type) and kind.__subclasses__() == [] else None
    except TypeError:
        return None


def _at(where: str, text: str) -> str:
    return f"{where.removeprefix('.')}: {text}" if where else text
