"""A value in a YAML tree together with what a pydantic model says it may be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from graphface.document.located import Map, Seq
from graphface.place import Place
from graphface.values.port_types import spelled_out

Keys = tuple[str | int, ...]
"""Of mappings and lists, from the whole tree to a value in it."""


@dataclass(frozen=True)
class TypedValue:
    """A value in the tree.

    Attributes:
        types: what it may be.
        field: that of the nearest model around it, and the keys that lead there.
        member: a word for the member of a union that it is.
        members: those of all unions on the way here as pydantic names them, with the keys of the value that is one.
    """

    value: Any
    place: Place | None
    types: tuple[Any, ...]
    keys: Keys = ()
    field: tuple[Keys, FieldInfo] | None = None
    member: str = ""
    members: tuple[tuple[Keys, str], ...] = ()

    def __str__(self) -> str:
        if not self.keys:
            return self.models[0].__name__
        path = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in self.keys).removeprefix(".")
        return f"{path} ({self.member})" if self.member else path

    @property
    def models(self) -> list[type[BaseModel]]:
        return [t for t in self.types if is_model(t)]

    @property
    def names(self) -> list[str]:
        """What a mapping here may hold."""
        return list(dict.fromkeys(name for model in self.models for name in fields(model)))

    def holds(self, key: str | int) -> bool:
        """Whether `key` of pydantic's leads inside; of what may be several things, it first names one of them."""
        if isinstance(self.value, Mapping):
            settled = self.members[-1:] and self.members[-1][0] == self.keys
            return key in self.value and (len(self.types) == 1 or bool(settled))
        return isinstance(self.value, list | tuple) and isinstance(key, int) and key < len(self.value)

    def inside(self, key: Any) -> TypedValue:
        place = None
        if isinstance(self.value, Map):
            place = self.value.value_place(key)
        elif isinstance(self.value, Seq):
            place = self.value.item_place(key)
        keys, field, types = (*self.keys, key), self.field, [a for t in self.types for a in items(t)]
        declared = next((fields(m)[key] for m in self.models if key in fields(m)), None)
        if declared is not None:
            field, types = (keys, declared), alternatives(declared.annotation)
        return TypedValue(self.value[key], place, tuple(types), keys, field, members=self.members)

    def as_member(self, label: str) -> TypedValue:
        models = tuple(m for m in self.models if goes_by(m, label))
        alike = tuple(t for t in self.types if label.partition("[")[0] == getattr(t, "__name__", ""))
        members = (*self.members, (self.keys, label))
        return replace(self, types=models or alike or self.types, member=label if models else "", members=members)

    def key_place(self, key: str) -> Place | None:
        return self.value.key_place(key) if isinstance(self.value, Map) else self.place


def fields(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """A model's fields by the names that a file gives them."""
    return {field.alias or name: field for name, field in model.model_fields.items()}


def choices_of(model: type[BaseModel], key: str) -> tuple[Any, ...]:
    """The values that a field of literals may have."""
    field = fields(model).get(key)
    return get_args(spelled_out(field.annotation)) if field is not None else ()


def goes_by(model: type[BaseModel], label: str) -> bool:
    """Whether pydantic calls this member of a union so: by its class, or by the value of its discriminator."""
    return label == model.__name__ or any(label in choices_of(model, key) for key in fields(model))


def is_model(annotation: Any) -> bool:
    return isinstance(annotation, type) and not get_args(annotation) and issubclass(annotation, BaseModel)


def alternatives(annotation: Any) -> list[Any]:
    """The members of a union without None, of which some may be unions; another type itself."""
    annotation = spelled_out(annotation)
    if get_origin(annotation) is Annotated:
        return alternatives(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        return [member for part in get_args(annotation) if part is not NoneType for member in alternatives(part)]
    return [annotation]


def items(annotation: Any) -> list[Any]:
    """What a list or mapping of this type holds."""
    origin, parts = get_origin(annotation), get_args(annotation)
    if isinstance(origin, type) and issubclass(origin, Mapping):
        parts = parts[1:]
    return [item for part in parts if part is not ... for item in alternatives(part)]


def holds_models(annotation: Any) -> bool:
    """Whether a value of this type may be a model or hold one."""
    return is_model(annotation) or any(holds_models(spelled_out(part)) for part in get_args(annotation))
