"""What a caller gives for a graph's inputs: files, arrays or values, known by content and loaded only when needed.

A bound input has its digest at once and its value when somebody asks for it, so that a fully memoized run decodes no
picture. Arrays of the caller are not copied: they are passed on as read-only views, and since the caller may still
write to them, a value that shares their memory is never memoized (`Bound.borrowed`).
"""

from __future__ import annotations

import copy
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from graphface.cache.digest import digest_file, digest_value
from graphface.errors import InputError, UnreadableFile, nearest_names
from graphface.frozen import arrays_in, buffer_of, freeze
from graphface.located import scalar
from graphface.values import ArrayType, Atom, PortType
from graphface.wiring import GraphInput

Reader = Callable[[Path], Any]


@dataclass(eq=False)
class Bound:
    """One graph input with what was given for it."""

    name: str
    digest: bytes
    origin: str
    load: Callable[[], Any] = field(repr=False)
    borrowed: frozenset[int] = frozenset()
    is_file: bool = False

    @cached_property
    def value(self) -> Any:
        """The value, loaded once.

        Raises:
            UnreadableFile, InputError: the file or object is not what the input takes.
        """
        value = self.load()
        if not self.borrowed:
            freeze(value)
        return value


def bind(
    inputs: Mapping[str, GraphInput],
    given: Mapping[str, Any],
    *,
    roots: Sequence[Path] = (),
    stat_shortcut: bool = True,
) -> dict[str, Bound]:
    """Bind every input of a graph to what was given, or to its default.

    Args:
        given: input name to a value, or to a path where the input's type can be read from a file.
        roots: folders in which relative paths are looked for: default files there only, given ones there at last.
        stat_shortcut: trust size and modification time of a file hashed before.

    Raises:
        InputError: an unknown input, or a value of the wrong type.
        UnreadableFile: a file that does not exist.
    """
    for name in given:
        if name not in inputs:
            raise InputError(
                name, f"the graph has no such input (it has {', '.join(inputs) or 'none'})", nearest_names(name, inputs)
            )
    return {
        name: _bind_one(entry, given, roots, stat_shortcut)
        for name, entry in inputs.items()
        if _has_value(entry, given)
    }


def missing_inputs(inputs: Mapping[str, GraphInput], given: Mapping[str, Any]) -> list[str]:
    return [name for name, entry in inputs.items() if not _has_value(entry, given)]


def reader_of(declared: PortType) -> Reader | None:
    """How a value of this type is read from a file, if it can be."""
    return next((r for a in declared.alternatives if (r := _atom_reader(a)) is not None), None)


def _has_value(entry: GraphInput, given: Mapping[str, Any]) -> bool:
    return entry.name in given or entry.default is not None or entry.type.optional


def _bind_one(entry: GraphInput, given: Mapping[str, Any], roots: Sequence[Path], stat_shortcut: bool) -> Bound:
    name, declared = entry.name, entry.type
    reader = reader_of(declared)
    if name in given:
        value = given[name]
        if reader is not None and isinstance(value, str | Path):
            return _bind_file(entry, _given_file(value, roots), reader, stat_shortcut)
        return _bind_object(entry, _from_text(value, declared))
    default = entry.default.value if entry.default is not None else None
    if reader is not None and isinstance(default, str):
        return _bind_file(entry, _default_file(entry, default, roots), reader, stat_shortcut)
    return _bind_object(entry, default)


def _bind_file(entry: GraphInput, path: Path, reader: Reader, stat_shortcut: bool) -> Bound:
    if os.path.isdir(path):
        raise UnreadableFile(path, f"is a folder; input {entry.name!r} takes a file ({entry.type})")
    try:
        content = digest_file(path, stat_shortcut=stat_shortcut)
    except UnreadableFile as error:
        raise UnreadableFile(path, f"{error.reason} (input {entry.name!r})") from None
    digest = digest_value(("file", str(entry.type), _code_of(reader), content))
    return Bound(entry.name, digest, str(path), lambda: reader(path), is_file=True)


def _bind_object(entry: GraphInput, value: Any) -> Bound:
    declared = entry.type

    def load() -> Any:
        try:
            return _read_only(declared.coerce(value))
        except (ValueError, TypeError) as error:
            raise InputError(entry.name, str(error)) from None

    if value is not None and declared.problem(value) is not None and not _coercible(declared):
        raise InputError(entry.name, declared.problem(value) or "")
    try:
        digest = digest_value(("value", str(declared), value))
    except TypeError as error:
        raise InputError(entry.name, str(error)) from None
    owned = (buffer_of(a) for _, a in arrays_in(value))
    borrowed = frozenset(id(a) for a in owned if a.flags.writeable or a.base is not None)
    return Bound(entry.name, digest, type(value).__name__, load, borrowed)


def _read_only(value: Any) -> Any:
    """The same value over read-only views; the caller's own arrays, at any depth, keep their flags."""
    if next(arrays_in(value), None) is None:
        return value
    if isinstance(value, np.ndarray):
        view = value.view()
        view.flags.writeable = False
        return view
    if isinstance(value, Mapping):
        return {key: _read_only(item) for key, item in value.items()}
    if isinstance(value, tuple) and hasattr(value, "_make"):
        return value._make(_read_only(item) for item in value)
    if isinstance(value, list | tuple):
        return type(value)(_read_only(item) for item in value)
    viewing = copy.copy(value)
    for part in fields(value):
        object.__setattr__(viewing, part.name, _read_only(getattr(value, part.name)))
    return viewing


def _from_text(value: Any, declared: PortType) -> Any:
    """A number, flag or path given as text on the command line, where the type is no text."""
    if isinstance(value, str) and Path in declared.alternatives:
        return Path(value)
    if isinstance(value, str) and str not in declared.alternatives:
        return scalar(value)
    return value


def _given_file(value: str | Path, roots: Sequence[Path]) -> Path:
    """The path given; where nothing is there, a file of that name beside the graph or among the shipped ones."""
    path = Path(value)
    if path.is_absolute() or os.path.exists(path):
        return path
    return next((root / path for root in roots if os.path.isfile(root / path)), path)


def _default_file(entry: GraphInput, name: str, roots: Sequence[Path]) -> Path:
    place = entry.default.place if entry.default is not None else None
    naming = [place.source.path.parent] if place is not None and place.source.path is not None else []
    for folder in (*naming, *roots):
        try:
            path = (folder / name).resolve()
            if path.is_file() and any(path.is_relative_to(root.resolve()) for root in roots):
                return path
        except (OSError, ValueError):  # a name that no file could have
            continue
    raise UnreadableFile(name, f"no such file beside the graph (default of input {entry.name!r}, {entry.place})")


def _atom_reader(atom: Atom) -> Reader | None:
    if isinstance(atom, ArrayType):
        return atom.from_file
    return getattr(atom, "from_file", None)


def _coercible(declared: PortType) -> bool:
    return any(hasattr(a, "coerce") for a in declared.alternatives) or any(
        isinstance(a, ArrayType) for a in declared.alternatives
    )


def _code_of(reader: Reader) -> bytes:
    from graphface.fingerprint import fingerprint

    function = getattr(reader, "__func__", reader)
    return fingerprint(function).digest
