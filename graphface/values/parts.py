"""What values are made of: one rule for each type, open to the types of others.

Freezing, digests, the disk tier, the guard against NaN, private copies of inputs, descriptions and .npz files all look
inside values. Each asks `rule_of` for a value's parts, and knows by itself only what has none: arrays, numbers, texts,
paths, enums. The rules of dataclasses, named tuples, pydantic models, lists, tuples, sets and mappings stand here. Any
other class adds its own beside itself; its values then work wherever those of a dataclass do:

    >>> import numpy as np
    >>> from graphface.values.frozen import describe, freeze
    >>> class Spline:
    ...     def __init__(self, knots: np.ndarray, degree: int = 3) -> None:
    ...         self.knots, self.degree = knots, degree
    >>> @register_parts(Spline)
    ... def spline_parts(spline: Spline) -> dict[str, Any]:
    ...     return {"knots": spline.knots, "degree": spline.degree}

    >>> spline = Spline(np.zeros(4))
    >>> buffers = freeze([spline])
    >>> spline.knots[0] = 1
    Traceback (most recent call last):
    ValueError: assignment destination is read-only
    >>> describe(spline)
    'Spline(knots=float64[4] 0..0, degree=3)'

Why not `functools.singledispatch`: being a dataclass shows in no base class, and a look-up takes 0.3 µs where a
dictionary by type takes 0.05. Every value that a node returns is walked twice.
"""

from __future__ import annotations

import copy
import typing
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from enum import Enum
from functools import cache
from typing import Any, TypeVar

T = TypeVar("T")

SCALARS = frozenset((int, bool, float, str, bytes, type(None)))
"""By far the most common types in large graphs of small nodes; they have no parts."""


@dataclass(frozen=True, slots=True)
class Rule:
    """How values of one type come apart, and how others are made like them.

    Attributes:
        items: from a value to the label and the value of each part; labels are numbers here, or the keys of a mapping.
        like: from a value and new parts, in the order of `items`, to a value like it.
        step: from a label to a step of a path: ".albedo", "[0]".
    """

    items: Callable[[Any], Iterable[tuple[Any, Any]]]
    like: Callable[[Any, Iterable[Any]], Any]
    step: Callable[[Any], str] = ".{}".format


def _nothing(value: Any) -> dict[str, Any]:
    return {}


@cache
def _hints(of: Any) -> dict[str, Any]:
    return typing.get_type_hints(of, include_extras=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Named(Rule):
    """The rule of records: labels are names, and a value can be built from its class and its parts alone.

    Attributes:
        build: from a class, parts by name and what `about` said of a value like it, to a value. Raises ValueError or
            TypeError where the parts are not those of the class.
        about: from a value to what it holds beside its parts, in terms of JSON.
        annotations: from a class to the declared types of its parts, as far as there are any.
    """

    build: Callable[[Any, dict[str, Any], Mapping[str, Any]], Any]
    about: Callable[[Any], dict[str, Any]] = _nothing
    annotations: Callable[[Any], dict[str, Any]] = _hints


def register_parts(
    kind: type[T], *, build: Callable[..., T] | None = None
) -> Callable[[Callable[[T], Mapping[str, Any]]], Callable[[T], Mapping[str, Any]]]:
    """Say what values of a class are made of; a decorator of a function from a value to its parts by name.

    Parts are what the value holds, not copies: an array that it does not get to see cannot be made read-only, and what
    no part tells counts in no digest. The rule holds for subclasses too.

    Args:
        build: called with the parts by name, gives the value again; by default the class. The annotations of its
            arguments say which classes the parts may have when they are read from the disk tier.
    """

    def built(cls: Any, given: dict[str, Any], about: Mapping[str, Any]) -> Any:
        return (build or cls)(**given)

    def register(parts: Callable[[T], Mapping[str, Any]]) -> Callable[[T], Mapping[str, Any]]:
        _registered[kind] = Named(
            lambda value: parts(value).items(),
            lambda value, changed: built(type(value), dict(zip(parts(value), changed, strict=True)), {}),
            build=built,
            annotations=lambda cls: _hints(build or cls.__init__),
        )
        _known.clear()
        return parts

    return register


def rule_of(kind: type) -> Rule | None:
    """The rule of a type; None where its values have no parts."""
    try:
        return _known[kind]
    except KeyError:
        rule = _known[kind] = _find(kind)
        return rule


@cache
def field_names(kind: type) -> tuple[str, ...]:
    """The fields of a dataclass."""
    return tuple(f.name for f in fields(kind))


def _find(kind: type) -> Rule | None:
    """The rule of the nearest base class that has one."""
    if issubclass(kind, Enum):
        return None
    for base in kind.__mro__:
        if base in _registered:
            return _registered[base]
        if "__dataclass_fields__" in vars(base):
            return DATACLASS
        if "_fields" in vars(base) and issubclass(base, tuple):
            return NAMED_TUPLE
    if hasattr(kind, "model_fields") and hasattr(kind, "model_dump"):  # pydantic, without importing it
        return MODEL
    return KEYED if issubclass(kind, Mapping) else None


def _dataclass_items(value: Any) -> list[tuple[str, Any]]:
    return [(name, getattr(value, name)) for name in field_names(value.__class__)]


def _dataclass_like(value: Any, parts: Iterable[Any]) -> Any:
    return _filled(copy.copy(value), zip(field_names(value.__class__), parts, strict=True))


def _build_dataclass(kind: Any, parts: dict[str, Any], about: Mapping[str, Any]) -> Any:
    """No constructor runs: it would copy arrays, and may not accept its own results."""
    _check_names(kind, parts, field_names(kind))
    return _filled(kind.__new__(kind), parts.items())


def _filled(instance: Any, parts: Iterable[tuple[str, Any]]) -> Any:
    for name, part in parts:
        object.__setattr__(instance, name, part)
    return instance


def _build_named_tuple(kind: Any, parts: dict[str, Any], about: Mapping[str, Any]) -> Any:
    _check_names(kind, parts, kind._fields)
    return kind(**parts)


def _model_items(value: Any) -> list[tuple[str, Any]]:
    held = vars(value)
    declared = [(name, held[name]) for name in type(value).model_fields if name in held]
    return [*declared, *(value.model_extra or {}).items()]


def _model_like(value: Any, parts: Iterable[Any]) -> Any:
    alike = value.model_copy()
    for (name, _), part in zip(_model_items(value), parts, strict=True):
        (vars(alike) if name in vars(alike) else alike.model_extra)[name] = part
    return alike


def _about_model(value: Any) -> dict[str, Any]:
    if getattr(value, "__pydantic_private__", None):
        raise ValueError(f"{type(value).__qualname__} has private attributes, which are not stored")
    return {"set": sorted(value.model_fields_set), "extra": sorted(value.model_extra or {})}


def _build_model(kind: Any, parts: dict[str, Any], about: Mapping[str, Any]) -> Any:
    _check_names(kind, parts, [*kind.model_fields, *about["extra"]])
    extra = {name: parts.pop(name) for name in about["extra"]}
    state = {"__dict__": parts, "__pydantic_fields_set__": set(about["set"]), "__pydantic_private__": None}
    keeps = kind.model_config.get("extra") == "allow"
    instance = kind.__new__(kind)
    instance.__setstate__(state | {"__pydantic_extra__": extra if keeps else None})
    return instance


def _check_names(kind: type, parts: Mapping[str, Any], expected: Iterable[str]) -> None:
    odd = sorted(set(parts) ^ set(expected))
    if odd:
        raise ValueError(f"{kind.__qualname__} has other fields now ({', '.join(odd)})")


NUMBERED = Rule(enumerate, lambda value, parts: type(value)(parts), "[{}]".format)
KEYED = Rule(lambda value: value.items(), lambda value, parts: dict(zip(value, parts, strict=True)))
DATACLASS = Named(_dataclass_items, _dataclass_like, build=_build_dataclass)
NAMED_TUPLE = Named(
    lambda value: zip(value._fields, value, strict=True),
    lambda value, parts: value._make(parts),
    build=_build_named_tuple,
)
MODEL = Named(_model_items, _model_like, build=_build_model, about=_about_model)

_registered: dict[type, Rule] = {list: NUMBERED, tuple: NUMBERED, set: NUMBERED, frozenset: NUMBERED, dict: KEYED}
_known: dict[type, Rule | None] = {}
