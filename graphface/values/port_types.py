"""The types of ports: what may travel along a wire, and what may be plugged into what.

A port's type is read from an ordinary annotation. Classes stand for themselves. An array alone says too little (a mask
and a depth map are both float32, H x W), so an array gets its meaning from an `ArrayType` inside `Annotated`:

    Mask = Annotated[NDArray[np.float32], ArrayType("Mask", "H W", low=0, high=1)]

To a type checker and in a notebook a `Mask` stays a plain NumPy array; to the engine it is a type of its own, checked
when a graph is wired and again when a value passes. Wrapping each map in a class was tried on paper and rejected:
every operator would begin and end by unwrapping.

A class may teach the engine one thing: `coerce(object)` accepts what people have at hand in a notebook (an array for an
image). What reads and writes files stands apart (`graphface.values.files`), and so does what draws values
(`graphface.values.picture`): a value knows neither.
A pydantic model (a scene) is small, and made by hand: it is read and checked as soon as it is given.
"""

from __future__ import annotations

import types
import typing
from collections.abc import Iterator
from dataclasses import dataclass, is_dataclass
from functools import cached_property
from typing import Annotated, Any, TypeVar

T = TypeVar("T")


class _LazyMarker:
    def __repr__(self) -> str:
        return "Lazy"


LAZY = _LazyMarker()

Lazy = Annotated[T | None, LAZY]
"""An input port that its node may decline; the argument is then None (see `graphface.node`)."""


@dataclass(frozen=True, eq=False)
class ArrayType:
    """The meaning of an array on a wire.

    Args:
        name: how graph files and messages call it.
        shape: one word per axis: a number, or a letter for a free axis ("H W 3"); "..." allows any shape.
        kind: NumPy dtype kinds allowed, as in `dtype.kind` ("f" floating, "i" integer, "b" boolean).
        low, high: the nominal range, for messages and pictures; values are not clipped.
        dtype: what arrays that enter a run from outside are converted to ("float32"); None leaves them.
        bounded: whether such arrays are refused where they leave the range; bool and unsigned are shares of 1.
        parent: the type that this one may stand in for.
    """

    name: str
    shape: str = "..."
    kind: str = "f"
    low: float | None = None
    high: float | None = None
    doc: str = ""
    parent: ArrayType | None = None
    dtype: str | None = None
    bounded: bool = False

    def is_a(self, other: ArrayType) -> bool:
        return self is other or (self.parent is not None and self.parent.is_a(other))

    def problem(self, value: object) -> str | None:
        """Why `value` is not of this type, or None where it is."""
        import numpy as np

        if not isinstance(value, np.ndarray):
            return f"expected an array ({self.name}), got {type(value).__name__}"
        if value.dtype.kind not in self.kind:
            return f"expected dtype kind {self.kind!r} for {self.name}, got {value.dtype}"
        if self.shape != "...":
            axes = self.shape.split()
            fits = len(axes) == value.ndim and all(
                not axis.isdigit() or int(axis) == n for axis, n in zip(axes, value.shape, strict=True)
            )
            if not fits:
                return f"expected shape ({', '.join(axes)}) for {self.name}, got {value.shape}"
        return None


@dataclass(frozen=True)
class ListOf:
    """`list[X]` on a port: several wires, or one wire that carries a list."""

    item: PortType

    def __str__(self) -> str:
        return f"list[{self.item}]"


Atom = ArrayType | ListOf | type


@dataclass(frozen=True)
class PortType:
    """The alternatives a port takes; `optional` where None is one of them."""

    alternatives: tuple[Atom, ...]
    optional: bool = False

    def __str__(self) -> str:
        return self._text

    @cached_property
    def _text(self) -> str:
        names = [_atom_name(a) for a in self.alternatives]
        return " | ".join(names + ["None"] * (self.optional and object not in self.alternatives))

    def accepts(self, source: PortType) -> bool:
        """Whether every value of `source` is a value of this type."""
        if source.optional and not self.optional:
            return False
        return all(any(_atom_accepts(mine, theirs) for mine in self.alternatives) for theirs in source.alternatives)

    def problem(self, value: object) -> str | None:
        """Why `value` is not of this type, or None where it is."""
        if value is None:
            return None if self.optional else f"expected {self}, got None"
        problems = []
        for atom in self.alternatives:
            reason = _atom_problem(atom, value)
            if reason is None:
                return None
            problems.append(reason)
        return problems[0] if len(problems) == 1 else f"expected {self}, got {type(value).__name__}"

    def coerce(self, value: object) -> object:
        """`value` as this type, using the `coerce` of a class where it has one and the value does not fit yet.

        Raises:
            ValueError: no alternative takes the value; the message says what was expected.
        """
        reason = self.problem(value)
        if reason is None:
            return value
        for atom in self.alternatives:
            if isinstance(atom, ListOf) and isinstance(value, list | tuple):
                return [atom.item.coerce(v) for v in value]
            convert = getattr(atom, "coerce", None) if isinstance(atom, type) else None
            if convert is not None:
                return convert(value)
        raise ValueError(reason)


ANY = PortType((object,), optional=True)


def port_type(annotation: Any) -> PortType:
    """The port type an annotation declares.

    Raises:
        TypeError: the annotation is not one a port can have.
    """
    atoms: list[Atom] = []
    optional = _collect(annotation, atoms)
    return PortType(tuple(dict.fromkeys(atoms)), optional)


def lineage(atom: Atom) -> Iterator[Atom]:
    """A type and what it is a kind of, nearest first."""
    if isinstance(atom, type):
        yield from atom.__mro__
        return
    yield atom
    while isinstance(atom, ArrayType) and atom.parent is not None:
        atom = atom.parent
        yield atom


def is_lazy(annotation: Any) -> bool:
    return LAZY in getattr(annotation, "__metadata__", ())


def spelled_out(annotation: Any) -> Any:
    """What an alias declared by `type X[T] = ...` stands for (NumPy's NDArray from 2.5 on); others as they are."""
    while (meaning := getattr(annotation, "__value__", None)) is not None:
        annotation = meaning
    return annotation


def array_of(annotation: Any) -> ArrayType | None:
    """The `ArrayType` inside an `Annotated`, if there is one."""
    return next((m for m in getattr(annotation, "__metadata__", ()) if isinstance(m, ArrayType)), None)


def output_fields(annotation: Any) -> dict[str, PortType]:
    """The ports that an output offers beside itself: the fields of a dataclass."""
    if typing.get_origin(annotation) is Annotated:
        return {}
    if not (isinstance(annotation, type) and is_dataclass(annotation)):
        return {}
    hints = typing.get_type_hints(annotation, include_extras=True)
    return {name: port_type(hints[name]) for name in annotation.__dataclass_fields__}


def _collect(annotation: Any, atoms: list[Atom]) -> bool:
    """Append the alternatives of `annotation` to `atoms`; True where None is one of them."""
    annotation = spelled_out(annotation)
    array = array_of(annotation)
    if array is not None:
        atoms.append(array)
        return False
    if annotation is None or annotation is type(None):
        return True
    if annotation is Any:
        atoms.append(object)
        return True
    origin = typing.get_origin(annotation)
    if origin is Annotated:
        return _collect(annotation.__origin__, atoms)
    if origin in (typing.Union, types.UnionType):
        return any([_collect(a, atoms) for a in typing.get_args(annotation)])  # noqa: C419 - visits every alternative
    if origin is typing.Literal:
        atoms.extend(type(choice) for choice in typing.get_args(annotation) if choice is not None)
        return None in typing.get_args(annotation)
    if origin is list:
        atoms.append(ListOf(port_type(typing.get_args(annotation)[0])))
        return False
    if origin is not None and isinstance(origin, type):
        atoms.append(origin)
        return False
    if isinstance(annotation, type):
        atoms.append(annotation)
        return False
    raise TypeError(f"a port cannot have the type {annotation!r}")


def _atom_name(atom: Atom) -> str:
    if isinstance(atom, type):
        return "Any" if atom is object else atom.__name__
    return atom.name if isinstance(atom, ArrayType) else str(atom)


def _atom_accepts(mine: Atom, theirs: Atom) -> bool:
    if mine is object or mine is theirs:
        return True
    if isinstance(mine, ListOf):
        return isinstance(theirs, ListOf) and mine.item.accepts(theirs.item)
    if isinstance(mine, ArrayType):
        return isinstance(theirs, ArrayType) and theirs.is_a(mine)
    if isinstance(theirs, ArrayType):
        import numpy as np

        return issubclass(np.ndarray, mine)
    if isinstance(theirs, ListOf):
        return issubclass(list, mine)
    return issubclass(theirs, mine) or (mine is float and theirs is int)


def _atom_problem(atom: Atom, value: object) -> str | None:
    if isinstance(atom, ArrayType):
        return atom.problem(value)
    if isinstance(atom, ListOf):
        if not isinstance(value, list | tuple):
            return f"expected {atom}, got {type(value).__name__}"
        return next((r for v in value if (r := atom.item.problem(v)) is not None), None)
    if isinstance(value, atom) and not (isinstance(value, bool) and atom in (int, float)):
        return None
    if atom is float and isinstance(value, int) and not isinstance(value, bool):
        return None
    return f"expected {_atom_name(atom)}, got {type(value).__name__}"
