"""What a caller gives for a graph's inputs: files, arrays or values, known by content and loaded only when needed.

A bound input has its digest at once and its value when somebody asks for it, so that a fully memoized run decodes no
picture. Only a pydantic model (a scene) is read at once: it is small, and its mistakes are found before anything runs.
The value is always what the digest was taken of, or results would be kept under the wrong keys: arrays that their owner
may still write to are copied, and a file that was written to between hashing and reading is refused.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from graphface.document.located import plain
from graphface.document.scalars import scalar
from graphface.errors import DocumentError, InputError, UnreadableFile, nearest_names
from graphface.graph.structure import GraphInput
from graphface.values.digest import digest_file, digest_value
from graphface.values.entering import entered
from graphface.values.files import FilesOf, Reader
from graphface.values.frozen import buffer_of, freeze, with_arrays
from graphface.values.parts import SCALARS
from graphface.values.port_types import ArrayType, PortType

_NONE = object()
_NOTHING: Mapping[str, Bound] = MappingProxyType({})


@dataclass(eq=False)
class Bound:
    """One graph input with what was given for it.

    Attributes:
        number: the number or text that was given, if it was one: given again, the same object has the same digest.
    """

    name: str
    digest: bytes
    origin: str
    load: Callable[[], Any] = field(repr=False)
    is_file: bool = False
    number: object = field(default=_NONE, repr=False)

    @property
    def is_number(self) -> bool:
        return self.number is not _NONE

    @cached_property
    def value(self) -> Any:
        """The value, loaded once.

        Raises:
            UnreadableFile, InputError: the file or object is not what the input takes.
        """
        value = self.load()
        freeze(value)
        return value


def bind(
    inputs: Mapping[str, GraphInput],
    given: Mapping[str, Any],
    files_of: FilesOf,
    *,
    roots: Sequence[Path] = (),
    stat_shortcut: bool = True,
    before: Mapping[str, Bound] = _NOTHING,
) -> dict[str, Bound]:
    """Bind every input of a graph to what was given, or to its default.

    Args:
        given: input name to a value, or to a path where the input's type can be read from a file, or to what an earlier
            call made of one.
        files_of: how types are read from files.
        roots: folders in which relative paths are looked for: default files there only, given ones there at last.
        stat_shortcut: trust size and modification time of a file hashed before.
        before: what was bound earlier; numbers in it that are given again are not hashed again.

    Raises:
        InputError: an unknown input, or a value of the wrong type.
        UnreadableFile: a file that does not exist.
        DocumentError: mistakes in a pydantic model's file, or in its default in the graph file.
    """
    for name in given:
        if name not in inputs:
            raise InputError(
                name, f"the graph has no such input (it has {', '.join(inputs) or 'none'})", nearest_names(name, inputs)
            )
    bound = {}
    for name, entry in inputs.items():
        known = before.get(name)
        if known is not None and known.number is given.get(name, _NONE):
            bound[name] = known
        elif _has_value(entry, given):
            bound[name] = _bind_one(entry, given, files_of, roots, stat_shortcut)
            if _is_model(entry.type):
                bound[name].value  # noqa: B018 - reads it
    return bound


def missing_inputs(inputs: Mapping[str, GraphInput], given: Mapping[str, Any]) -> list[str]:
    return [name for name, entry in inputs.items() if not _has_value(entry, given)]


def _has_value(entry: GraphInput, given: Mapping[str, Any]) -> bool:
    return entry.name in given or entry.default is not None or entry.type.optional


def _bind_one(
    entry: GraphInput, given: Mapping[str, Any], files_of: FilesOf, roots: Sequence[Path], stat_shortcut: bool
) -> Bound:
    name, declared = entry.name, entry.type
    files = files_of(declared)
    reader = files.read if files is not None else None
    if name in given:
        value = given[name]
        if isinstance(value, Bound):
            return value
        if reader is not None and isinstance(value, str | Path):
            return _bind_file(entry, _given_file(value, roots), reader, stat_shortcut)
        return _bind_object(entry, _from_text(value, declared))
    default = entry.default.value if entry.default is not None else None
    if not _is_model(declared):
        default = plain(default)
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

    def load() -> Any:
        value = reader(path)
        if digest_file(path, stat_shortcut=stat_shortcut) != content:
            raise UnreadableFile(path, f"was changed while it was in use (input {entry.name!r}); run again")
        try:
            return entered(value, entry.type)
        except ValueError as error:
            raise UnreadableFile(path, f"holds no {entry.type} that can be used: {error}") from None

    return Bound(entry.name, digest, str(path), load, is_file=True)


def _bind_object(entry: GraphInput, value: Any) -> Bound:
    declared = entry.type
    if hasattr(type(value), "__array_interface__") and not isinstance(value, np.ndarray | np.generic):
        value = _of_others(entry.name, value, declared)
    if value is not None and declared.problem(value) is not None and not _coercible(declared):
        raise InputError(entry.name, declared.problem(value) or "")
    try:
        own = with_arrays(value, _own)
        digest = digest_value(("value", str(declared), plain(own)))
    except TypeError as error:
        raise InputError(entry.name, str(error)) from None

    def load() -> Any:
        try:
            return _fitting(own, declared)
        except DocumentError as error:
            if all(problem.place is not None for problem in error.problems):
                raise
            raise InputError(entry.name, str(error)) from None
        except (ValueError, TypeError) as error:
            raise InputError(entry.name, str(error)) from None

    number = value if type(value) in SCALARS else _NONE
    return Bound(entry.name, digest, type(value).__name__, load, number=number)


def _of_others(name: str, value: Any, declared: PortType) -> Any:
    """What another library holds an array in (Pillow a picture), as a value with a digest."""
    try:
        if any(isinstance(atom, ArrayType) for atom in declared.alternatives):
            return np.array(value)
        return declared.coerce(value)
    except (ValueError, TypeError) as error:
        raise InputError(name, str(error)) from None


def _fitting(value: Any, declared: PortType) -> Any:
    """A value as its type takes it; an array is converted first, since its dtype may be all that does not fit."""
    if isinstance(value, np.ndarray) and any(isinstance(atom, ArrayType) for atom in declared.alternatives):
        return entered(value, declared)
    return entered(declared.coerce(value), declared)


def _own(array: np.ndarray) -> np.ndarray:
    """The same array where nobody can write to it, else a copy."""
    return array if _settled(array) else array.copy()


def _settled(array: np.ndarray) -> bool:
    """Whether nobody can write to an array: neither it nor what owns its memory is writable."""
    owner = buffer_of(array)
    return not (array.flags.writeable or owner.flags.writeable) and (
        owner.base is None or isinstance(owner.base, bytes)
    )


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


def _is_model(declared: PortType) -> bool:
    return any(hasattr(atom, "model_fields") for atom in declared.alternatives)


def _coercible(declared: PortType) -> bool:
    return any(hasattr(a, "coerce") for a in declared.alternatives) or any(
        isinstance(a, ArrayType) for a in declared.alternatives
    )


def _code_of(reader: Reader) -> bytes:
    from graphface.fingerprint import fingerprint

    function = getattr(reader, "__func__", reader)
    return fingerprint(function).digest
