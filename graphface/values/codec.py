"""Values as arrays and JSON, and back: what the disk tier stores.

`encode` reads the value: arrays go into a table of tensors, everything else becomes JSON in which each thing that JSON
does not know is an object with one tag. `decode` is directed by the operator's return annotation: a class is only ever
built because the annotation names it (or is a loaded subclass of one it names), never because a file does. No pickle.
What a record is made of, and how it is built again, says `graphface.values.parts`.

    encode(Intrinsic(albedo, shading))  ->  {"0": albedo, "1": shading},
        {"record": "graphface.nodes.types.Intrinsic", "fields": {"albedo": {"array": "0"}, "shading": {"array": "1"}}}
"""

from __future__ import annotations

import base64
import typing
from collections.abc import Callable, Iterator, Mapping
from enum import Enum
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, Literal, Union

import numpy as np

from graphface.errors import RunError
from graphface.values.parts import Named, rule_of
from graphface.values.port_types import array_of, spelled_out

Tensors = dict[str, np.ndarray[Any, Any]]

TENSOR_DTYPES = ("bool", "u1", "i1", "<u2", "<i2", "<f2", "<u4", "<i4", "<f4", "<u8", "<i8", "<f8")
"""What safetensors stores; any other dtype travels as bytes, with its description beside them."""

_TENSOR_DTYPES = frozenset(np.dtype(d) for d in TENSOR_DTYPES)


class CodecError(RunError, ValueError):
    """A value that cannot be stored, or a stored one that is not what the annotation says; `where` is the field."""

    def __init__(self, message: str, where: str = "") -> None:
        super().__init__(f"{where}: {message}" if where else message)
        self.where = where


def encode(value: object) -> tuple[Tensors, Any]:
    """`value` as named arrays (C order, not copied where they are already) and a JSON-able structure.

    Raises:
        CodecError: some part of it is of no kind that can be stored.
    """
    tensors: Tensors = {}
    return tensors, _Encoder(tensors).write(value, "")


def decode(tensors: Mapping[str, np.ndarray[Any, Any]], structure: Any, annotation: Any) -> Any:
    """The value that `encode` was given, its arrays read-only and not copied.

    Args:
        annotation: the type the value is declared to have, as from `get_type_hints(include_extras=True)`.

    Raises:
        CodecError: structure, arrays and annotation do not fit together.
    """
    try:
        return _Decoder(tensors).read(structure, annotation, "")
    except (KeyError, TypeError, ValueError, AttributeError, RecursionError) as error:
        if isinstance(error, CodecError):
            raise
        raise CodecError(f"malformed structure ({type(error).__name__}: {error})") from error


_WRITTEN: dict[type, Callable[[Any], Any]] = {
    int: lambda value: {"int": hex(value)} if value.bit_length() > 1000 else value,
    float: lambda value: value if np.isfinite(value) else {"float": repr(value)},
    complex: lambda value: {"complex": [_WRITTEN[float](value.real), _WRITTEN[float](value.imag)]},
    bytes: lambda value: {"bytes": base64.b64encode(value).decode()},
}
"""Numbers and bytes as JSON has them; what it cannot say, as an object with one tag."""


class _Encoder:
    def __init__(self, tensors: Tensors) -> None:
        self._tensors = tensors
        self._stored: dict[int, tuple[object, str]] = {}

    def write(self, value: Any, where: str) -> Any:
        kind = type(value)
        if value is None or kind in (bool, str):
            return value
        if kind in _WRITTEN:
            return _WRITTEN[kind](value)
        if isinstance(value, np.ndarray):
            return self._array(value, where)
        if isinstance(value, np.generic):
            return {"scalar": self._array(np.asarray(value), where)}
        if isinstance(value, Path):
            return {"path": str(value)}
        if isinstance(value, Enum):
            return {"enum": _name(kind), "member": value.name}
        if kind in (list, tuple):
            return {kind.__name__: [self.write(item, f"{where}[{i}]") for i, item in enumerate(value)]}
        if kind is dict:
            return {"dict": [[self.write(k, where), self.write(v, f"{where}[{k!r}]")] for k, v in value.items()]}
        rule = rule_of(kind)
        if not isinstance(rule, Named):
            raise CodecError(f"a value of type {_name(kind)} cannot be stored", where)
        written = {name: self.write(part, where + rule.step(name)) for name, part in rule.items(value)}
        return {"record": _name(kind), "fields": written} | _about(rule, value, where)

    def _array(self, array: Any, where: str) -> dict[str, Any]:
        if type(array) not in (np.ndarray, np.memmap) or array.dtype.hasobject:
            raise CodecError(f"a {_name(type(array))} of dtype {array.dtype} cannot be stored", where)
        if id(array) in self._stored:
            return {"array": self._stored[id(array)][1]} | self._description(array)
        name = str(len(self._tensors))
        self._stored[id(array)] = (array, name)
        # ascontiguousarray would turn shape () into (1,)
        contiguous = np.ascontiguousarray(array).reshape(array.shape)
        plain = array.dtype in _TENSOR_DTYPES
        self._tensors[name] = contiguous if plain else np.frombuffer(contiguous.tobytes(), np.uint8)
        return {"array": name} | self._description(array)

    def _description(self, array: Any) -> dict[str, Any]:
        if array.dtype in _TENSOR_DTYPES:
            return {}
        return {"dtype": np.lib.format.dtype_to_descr(array.dtype), "shape": list(array.shape)}


class _Decoder:
    def __init__(self, tensors: Mapping[str, np.ndarray[Any, Any]]) -> None:
        self._tensors = tensors

    def read(self, data: Any, annotation: Any, where: str) -> Any:
        """One value; the annotation decides the class of records and enums and is checked against the rest."""
        problem: CodecError | None = None
        for choice in _alternatives(annotation):
            try:
                return self._read_as(data, choice, where)
            except CodecError as error:
                problem = problem or error
        raise problem or CodecError(f"nothing fits {annotation!r}", where)

    def _read_as(self, data: Any, annotation: Any, where: str) -> Any:
        if isinstance(data, dict) and "record" in data:
            return self._record(data, annotation, where)
        if isinstance(data, dict) and "enum" in data:
            return _class_named(data["enum"], annotation, where)[data["member"]]
        value = self._plain(data, annotation, where)
        _check(value, annotation, where)
        return value

    def _plain(self, data: Any, annotation: Any, where: str) -> Any:
        if not isinstance(data, dict):
            if data is None or isinstance(data, bool | int | float | str):
                return data
            raise CodecError("malformed structure", where)
        tag = next(iter(data), "")
        if tag == "array":
            return self._array(data)
        if tag == "scalar":
            return self._array(data["scalar"])[()]
        if tag == "list":
            return [self.read(d, a, f"{where}[{i}]") for i, (d, a) in enumerate(_items(data["list"], annotation))]
        if tag == "tuple":
            pairs = enumerate(_items(data["tuple"], annotation))
            return tuple(self.read(d, a, f"{where}[{i}]") for i, (d, a) in pairs)
        if tag == "dict":
            of_key, of_value = (*_arguments(annotation), Any, Any)[:2]
            return {self.read(k, of_key, where): self.read(v, of_value, f"{where}[{k!r}]") for k, v in data["dict"]}
        if tag in _SCALARS:
            return _SCALARS[tag](data[tag])
        raise CodecError(f"unknown tag {tag!r}", where)

    def _array(self, data: dict[str, Any]) -> Any:
        array = self._tensors[data["array"]]
        if "dtype" in data:
            dtype = np.lib.format.descr_to_dtype(_as_descr(data["dtype"]))
            if dtype.hasobject:
                raise CodecError("a stored array claims to hold objects")
            array = np.frombuffer(array.tobytes(), dtype).reshape(data["shape"])
        array = array.view()
        array.flags.writeable = False
        return array

    def _record(self, data: dict[str, Any], annotation: Any, where: str) -> Any:
        kind = _class_named(data["record"], annotation, where)
        rule = rule_of(kind)
        if not isinstance(rule, Named):
            raise CodecError(f"nobody says what a {_name(kind)} is made of", where)
        hints = rule.annotations(kind)
        parts = {
            name: self.read(part, hints.get(name, Any), where + rule.step(name))
            for name, part in data["fields"].items()
        }
        return rule.build(kind, parts, data)


_SCALARS: dict[str, Callable[[Any], Any]] = {
    "int": lambda text: int(text, 16),
    "float": float,
    "complex": lambda parts: complex(*(float(p["float"]) if isinstance(p, dict) else p for p in parts)),
    "bytes": lambda text: base64.b64decode(text, validate=True),
    "path": Path,
}


def _about(rule: Named, value: Any, where: str) -> dict[str, Any]:
    try:
        return rule.about(value)
    except ValueError as error:
        raise CodecError(str(error), where) from None


def _check(value: Any, annotation: Any, where: str) -> None:
    """That `value` is what the annotation says, as far as the annotation says anything.

    Raises:
        CodecError: it is not.
    """
    array = array_of(annotation)
    problem = array.problem(value) if array is not None else None
    if problem is not None:
        raise CodecError(problem, where)
    origin = _bare(annotation)
    if origin is Literal:
        if value not in typing.get_args(annotation):
            raise CodecError(f"{value!r} is none of {typing.get_args(annotation)}", where)
    elif isinstance(origin, type) and not isinstance(value, origin) and not _stands_in(value, origin):
        raise CodecError(f"expected {origin.__qualname__}, found {type(value).__qualname__}", where)


def _stands_in(value: Any, kind: type) -> bool:
    """An int for a float, a NumPy scalar for the Python number: what operators return under such annotations."""
    if isinstance(value, np.generic):
        return kind in (int, float, bool, complex)
    return kind in (float, complex) and isinstance(value, int | float)


def _alternatives(annotation: Any) -> Iterator[Any]:
    """The members of a union, each still with its metadata; the annotation itself otherwise."""
    inner = _unmarked(annotation)
    if typing.get_origin(inner) in (Union, UnionType):
        for member in typing.get_args(inner):
            yield from _alternatives(member)
    else:
        yield type(None) if annotation is None else annotation


def _bare(annotation: Any) -> Any:
    """The class behind an annotation (`object` for Any), or `Literal`, or what is no class and says nothing."""
    annotation = _unmarked(annotation)
    return object if annotation is Any else typing.get_origin(annotation) or annotation


def _arguments(annotation: Any) -> tuple[Any, ...]:
    return typing.get_args(_unmarked(annotation))


def _unmarked(annotation: Any) -> Any:
    """The annotation without metadata, aliases spelled out."""
    while typing.get_origin(annotation := spelled_out(annotation)) is Annotated:
        annotation = annotation.__origin__
    return annotation


def _items(data: list[Any], annotation: Any) -> Iterator[tuple[Any, Any]]:
    """Each stored item with its annotation: `list[X]`, `tuple[X, ...]`, `tuple[X, Y]`, or nothing known."""
    arguments = _arguments(annotation)
    if _bare(annotation) is tuple and len(arguments) > 1 and arguments[-1] is not ...:
        if len(arguments) != len(data):
            raise CodecError(f"expected {len(arguments)} items, found {len(data)}")
        return zip(data, arguments, strict=True)
    return ((item, arguments[0] if arguments else Any) for item in data)


def _class_named(name: str, annotation: Any, where: str) -> Any:
    """The class that the annotation means, or one of its loaded subclasses, if it is called `name`."""
    base = _bare(annotation)
    pending = [base] if isinstance(base, type) and base is not object else []
    while pending:
        kind = pending.pop()
        if _name(kind) == name:
            return kind
        pending.extend(type.__subclasses__(kind))
    raise CodecError(f"a stored {name} is not a {annotation!r}", where)


def _as_descr(data: Any) -> Any:
    """JSON made lists of the tuples in a dtype's description."""
    if isinstance(data, str):
        return data
    return [(name, _as_descr(kind), *map(tuple, shape)) for name, kind, *shape in data]


def _name(kind: type) -> str:
    return f"{kind.__module__}.{kind.__qualname__}"
