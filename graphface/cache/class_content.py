"""What of a class is its author's, and counts: the rest Python, dataclasses, enum and pydantic derive from it."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from enum import Enum
from types import FunctionType
from typing import Any

_MACHINERY = frozenset(
    {
        "__dict__",
        "__doc__",
        "__module__",
        "__qualname__",
        "__weakref__",
        "__firstlineno__",
        "__static_attributes__",
        "__annotations_cache__",
        "__abstractmethods__",
        "__dataclass_fields__",
        "__dataclass_params__",
        "__match_args__",
        "__parameters__",
        "__orig_bases__",
        "__signature__",
        "__class_vars__",
        "__private_attributes__",
        "__hash__",
        "__replace__",
        "_abc_impl",
    }
)


def own_names(kind: type) -> list[str]:
    """The attributes that the class itself states, sorted."""
    return [name for name in sorted(vars(kind)) if not _derived(kind, name)]


def dataclass_fields(kind: type) -> list[tuple[Any, ...]]:
    """Of each field of a dataclass: name, in `__init__`, compared, keyword only, default and default factory."""
    found = []
    for field in fields(kind):
        defaults = [
            None if d.__class__.__name__ == "_MISSING_TYPE" else (d,) for d in (field.default, field.default_factory)
        ]
        found.append((field.name, field.init, field.compare, bool(field.kw_only), *defaults))
    return found


def model_fields(kind: type) -> list[tuple[str, tuple[Any, ...]]]:
    """Of each field of a pydantic model: name; annotation, default, default factory and constraints."""
    if "__pydantic_fields__" not in vars(kind):
        return []
    infos = getattr(kind, "model_fields", {}).items()
    return [(n, (str(i.annotation), i.default, i.default_factory, list(i.metadata))) for n, i in infos]


def written_annotations(hints: dict[str, Any]) -> dict[str, str]:
    """Annotations as written; resolved ones by name, since their repr may hold addresses."""
    return {name: hint if isinstance(hint, str) else getattr(hint, "__qualname__", "") for name, hint in hints.items()}


def _derived(kind: type, name: str) -> bool:
    if name in _MACHINERY or name.startswith("__pydantic_") or name == "model_fields":
        return True
    if issubclass(kind, Enum) and (name in kind.__members__ or name.startswith("_")):
        return True
    value = getattr(vars(kind)[name], "__wrapped__", vars(kind)[name])
    return isinstance(value, FunctionType) and is_dataclass(kind) and value.__code__.co_filename == "<string>"
