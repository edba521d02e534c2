"""A saved failure read and run again, alone: the node's function with the same arguments, on whatever machine.

The file may come from a stranger. Nothing of it is unpacked to disk and no name in it becomes a path; sizes are checked
before memory is taken; classes are built only where the installed operator's own annotations name them.
"""

from __future__ import annotations

import json
import re
import zipfile
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import IO, Any, Literal

import numpy as np
from pydantic import BaseModel, ValidationError

from graphface.code_line import CodeLine, own_line
from graphface.document.mistakes import reason as mistake
from graphface.errors import UnreadableFile, UsageError, did_you_mean, nearest_names
from graphface.evaluate.calling import reason_of
from graphface.fallback import python_warnings
from graphface.fingerprint import Fingerprint, fingerprint
from graphface.node import Operator
from graphface.registry import Registry, default_registry
from graphface.report.failure import FORMAT, MANIFEST
from graphface.values.codec import CodecError, Tensors, decode
from graphface.values.frozen import first_non_finite, freeze

MAX_BYTES = 4 << 30
"""What all arrays of a file may come to."""
_MAX_MANIFEST = 16 << 20
_ARRAY = re.compile(r"(inputs|parameters)/(\d{1,9})\.npy")
_BROKEN = (OSError, ValueError, TypeError, KeyError, EOFError, NotImplementedError, RuntimeError)


class Manifest(BaseModel):
    """`failure.json`; see `graphface.report.failure`."""

    format: Literal["graphface-failure/1"]
    graph: str
    node: str
    place: str
    operator: str
    version: int
    code: str
    reached: list[str]
    error: str
    others: list[str]
    versions: dict[str, str]
    platform: str
    inputs: dict[str, Any]
    parameters: dict[str, Any]


@dataclass(frozen=True, eq=False)
class Replayed:
    """What running it now came to: a value, or an error with its sentence and the line of the operator's own code."""

    value: Any = None
    error: Exception | None = None
    reason: str = ""
    line: CodeLine | None = None


@dataclass(frozen=True, eq=False)
class Failure:
    """A node as it failed.

    Attributes:
        about: what the file says of it.
        registry: where its operator is looked up.
    """

    path: Path
    about: Manifest
    registry: Registry
    tensors: Mapping[str, Tensors] = field(repr=False)

    def operator(self, registry: Registry | None = None) -> Operator:
        """The operator as it is installed here.

        Raises:
            UnknownOperator: it is not.
        """
        return (registry or self.registry).operator(self.about.operator)

    @cached_property
    def arguments(self) -> dict[str, Any]:
        """What it was given, by port; arrays are read-only.

        Raises:
            UnreadableFile: a value is not what the port of the operator takes here, or is a path of another machine.
            UnknownOperator: the operator is not installed.
        """
        return self._decoded("inputs", self.about.inputs, self.operator().inputs)

    def parameters(self, changes: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """Its parameters as the operator takes them here, with changes.

        Raises:
            UsageError: there is no such parameter, or a value is out of its range. UnreadableFile: as for `arguments`.
        """
        operator, changes = self.operator(), changes or {}
        known = operator.parameters.model_fields
        for name in changes:
            if name not in known:
                near = did_you_mean(nearest_names(name, known))
                raise UsageError(
                    f"{operator.name} has no parameter {name!r} (it has {', '.join(known) or 'none'}){near}"
                )
        stored = {name: data for name, data in self.about.parameters.items() if name not in changes}
        given = {**self._decoded("parameters", stored, known), **changes}
        try:
            checked = operator.parameters.model_validate(given)
        except ValidationError as error:
            detail = error.errors(include_url=False)[0]
            where = ".".join(map(str, detail["loc"]))
            raise UsageError(f"parameter {where!r} of {operator.name}: {mistake(detail)}") from None
        return {name: getattr(checked, name) for name in known}

    def code_here(self) -> Fingerprint:
        """The fingerprint of the operator's code here; that of then is `about.code`."""
        operator = self.operator()
        return fingerprint(operator.function, operator.needs)

    def code_changes(self) -> list[str] | None:
        """None where the code is the same as then, else which packages are others, as far as that is known."""
        here, operator = self.code_here(), self.operator()
        if here.digest.hex() == self.about.code and operator.version == self.about.version:
            return None
        before, now = set(self.about.reached), set(here.reached)
        return [*(f"{one} then" for one in sorted(before - now)), *(f"{one} now" for one in sorted(now - before))]

    def run(self, changes: Mapping[str, Any] | None = None) -> Replayed:
        """Call the function once more, its output checked as in a run.

        Args:
            changes: parameters to set otherwise.

        Raises:
            UsageError, UnreadableFile: see `arguments` and `parameters`.
        """
        operator, given = self.operator(), {**self.arguments, **self.parameters(changes)}
        freeze(list(given.values()))
        try:
            with python_warnings():
                value = operator.function(**given)
        except Exception as error:
            return Replayed(None, error, reason_of(error), own_line(error, operator.function))
        problem = operator.output.problem(value)
        if problem is not None:
            wrong = TypeError(f"returned something else: {problem}")
            return Replayed(None, wrong, reason_of(wrong))
        found = first_non_finite(value, {})
        if found is not None:
            return Replayed(None, ValueError(f"its output {found}"), f"its output {found}")
        return Replayed(value)

    def _decoded(self, kind: str, stored: Mapping[str, Any], known: Any) -> dict[str, Any]:
        operator, values = self.operator(), {}
        for name, data in stored.items():
            what = f"{'input' if kind == 'inputs' else 'parameter'} {name!r} of {operator.name}"
            if name not in known:
                raise UnreadableFile(self.path, f"{what}: there is none here")
            if _holds_path(data):
                hint = "" if kind == "inputs" else f"; set it with --set {name}=FILE"
                raise UnreadableFile(self.path, f"{what} is a file of the machine where it failed{hint}")
            try:
                values[name] = decode(self.tensors[kind], data, operator.annotation(name))
            except CodecError as error:
                raise UnreadableFile(self.path, f"{what}: {error}") from None
        return values


def load_failure(path: str | Path, registry: Registry | None = None) -> Failure:
    """Read what `graphface run --save-failure` wrote.

    Args:
        registry: where the operator is looked up; everything installed by default.

    Raises:
        UnreadableFile: it is no such file, is damaged, or holds more than `MAX_BYTES`.
    """
    path = Path(path)
    try:
        with zipfile.ZipFile(path) as archive:
            about = _manifest(archive)
            tensors = _arrays(archive)
    except OSError as error:
        raise UnreadableFile(path, error.strerror or str(error)) from None
    except (*_BROKEN, zipfile.BadZipFile, zlib.error) as error:
        said = str(error).partition("\n")[0]
        raise UnreadableFile(path, f"is no saved failure, or a damaged one ({said or type(error).__name__})") from None
    return Failure(path, about, registry if registry is not None else default_registry(), tensors)


def _manifest(archive: zipfile.ZipFile) -> Manifest:
    with archive.open(MANIFEST) as member:
        text = member.read(_MAX_MANIFEST + 1)
    if len(text) > _MAX_MANIFEST:
        raise ValueError(f"{MANIFEST} is too large")
    data = json.loads(text)
    found = data.get("format") if isinstance(data, dict) else None
    if found != FORMAT:
        raise ValueError(f"its format is {found!r}, not {FORMAT!r}")
    try:
        return Manifest.model_validate(data, strict=True)
    except ValidationError as error:
        detail = error.errors(include_url=False)[0]
        raise ValueError(f"{MANIFEST}: {'.'.join(map(str, detail['loc']))}: {detail['msg']}") from None


def _arrays(archive: zipfile.ZipFile) -> dict[str, Tensors]:
    """The arrays by folder and number; what else the file holds is not looked at."""
    found: dict[str, Tensors] = {"inputs": {}, "parameters": {}}
    left = MAX_BYTES
    for info in archive.infolist():
        named = _ARRAY.fullmatch(info.filename)
        if named is None:
            continue
        with archive.open(info) as member:
            array = _read_array(member, left, info.filename)
        left -= array.nbytes
        found[named[1]][named[2]] = array
    return found


def _read_array(member: IO[bytes], most: int, name: str) -> np.ndarray[Any, Any]:
    """One .npy of at most so many bytes, however many its compressed form claims or comes to."""
    read_header: dict[tuple[int, int], Callable[..., Any]] = {
        (1, 0): np.lib.format.read_array_header_1_0,
        (2, 0): np.lib.format.read_array_header_2_0,
    }
    version = np.lib.format.read_magic(member)
    if version not in read_header:
        raise ValueError(f"{name} is of an unknown version")
    shape, fortran, dtype = read_header[version](member)
    size = dtype.itemsize
    for length in shape:
        size *= length
    if dtype.hasobject or not 0 <= size <= most or any(length < 0 for length in shape):
        raise ValueError(f"{name} holds objects, or is too large")
    data = member.read(size + 1)
    if len(data) != size:
        raise ValueError(f"{name} is cut off, or longer than it says")
    return np.frombuffer(data, dtype).reshape(shape, order="F" if fortran else "C")


def _holds_path(data: Any) -> bool:
    """Whether a stored value is a path or holds one: an operator would open it."""
    pending = [data]
    while pending:
        current = pending.pop()
        if isinstance(current, dict):
            if set(current) == {"path"}:
                return True
            pending.extend(current.values())
        elif isinstance(current, list):
            pending.extend(current)
    return False
