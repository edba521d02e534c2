"""Results to files: by who writes their type (`graphface.values.files`), or as plain arrays.

A file appears whole or not at all: it is written beside its place under another name and then renamed. What a symbolic
link points to is replaced, the link stays. A folder that is missing is made when there is something to put in it.
"""

from __future__ import annotations

import inspect
import os
import secrets
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np

from graphface.errors import GraphfaceError, RefusedOutput, UnwritableFile
from graphface.values.files import Files, FilesOf
from graphface.values.frozen import arrays_in
from graphface.values.port_types import ArrayType, Atom, PortType
from graphface.values.whole_file import create, replacing

PICTURE_SUFFIXES = (".png", ".jpg", ".jpeg", ".webp")
"""What any value can be drawn as, where its type has no writer of its own for it."""


def write_output(
    value: Any, declared: PortType, path: Path, files_of: FilesOf, *, text: Mapping[str, str] | None = None
) -> None:
    """Write a value as the suffix says: .npy (an array), .npz (every array in it), else as its type is written.

    Args:
        files_of: how types are written.
        text: words to keep inside the file, where that can be.

    Raises:
        UnwritableFile: the folder is read-only, the type cannot be written as that, or its writer failed.
    """
    _make_folder_of(path)
    if path.suffix == ".npy" and isinstance(value, np.ndarray):
        _write_with(path, lambda beside: np.save(beside, value, allow_pickle=False))
    elif path.suffix == ".npz":
        named = {name or "value": array for name, array in arrays_in(value)}
        if not named:
            raise UnwritableFile(path, f"a {type(value).__name__} holds no array")
        _write_with(path, lambda beside: np.savez(beside, **named))  # type: ignore[arg-type]
    else:
        files = _files(value, declared, files_of)
        if files is None or files.write is None:
            raise UnwritableFile(path, f"a {type(value).__name__} can only be written as .npz")
        writer = files.write
        try:
            if text and "text" in inspect.signature(writer).parameters:
                writer(value, path, text=text)
            else:
                writer(value, path)
        except GraphfaceError:
            raise
        except OSError as error:
            raise UnwritableFile(path, error.strerror or str(error)) from None
        except Exception as error:
            raise UnwritableFile(path, f"its writer failed ({type(error).__name__}: {error})") from error


def check_folder(path: Path) -> None:
    """See before anything runs that a result could be written there, its folder made where it is missing.

    Raises:
        RefusedOutput: the path is a folder or no ordinary file, or its folder is read-only or cannot be made.
    """
    try:
        if path.is_dir():
            raise RefusedOutput(path, "is a folder; name a file in it")
        place = Path(os.path.realpath(path))
        if place.exists() and not place.is_file():
            raise RefusedOutput(path, "is no ordinary file; give the result another name")
        folder = _nearest_folder(place)
        handle, name = tempfile.mkstemp(prefix=".graphface-", dir=folder)
    except NotADirectoryError:
        raise RefusedOutput(path, "cannot be written: a file has the name of one of its folders") from None
    except OSError as error:
        raise RefusedOutput(path, f"cannot be written: {error.strerror}") from None
    os.close(handle)
    os.unlink(name)


def _nearest_folder(place: Path) -> Path:
    """The nearest folder above a path that is there; what is missing below it could be made.

    Raises:
        OSError: it could not be: a name is too long, or a file has the name of a folder.
    """
    missing = [place]
    while not os.path.lexists(missing[-1].parent):
        missing.append(missing[-1].parent)
    folder = missing[-1].parent
    for one in missing:
        with suppress(FileNotFoundError):
            os.lstat(folder / one.name)
    return folder


def check_output(path: Path, declared: PortType, files_of: FilesOf) -> None:
    """As `check_folder`, and that a value of the declared type can be written, or drawn, under that suffix.

    Raises:
        RefusedOutput: nothing can be written there, or no writer knows the suffix.
        UsageError: the writer lacks something here, a package, say.
    """
    check_folder(path)
    for atom in declared.alternatives:
        files = files_of(atom)
        if (
            files is not None
            and files.check is not None
            and path.suffix.lower() in (files.suffixes or (path.suffix.lower(),))
        ):
            files.check(path)
    known = _own_suffixes(declared, files_of)
    if known is None or path.suffix.lower() in (*known, *PICTURE_SUFFIXES):
        return
    reason = f"no {declared} can be written as {path.suffix!r}" if path.suffix else "its name has no suffix"
    drawn = f", or as its picture: {', '.join(PICTURE_SUFFIXES)}" if PICTURE_SUFFIXES[0] not in known else ""
    raise RefusedOutput(path, f"{reason}; use {' or '.join(dict.fromkeys(known))}{drawn}")


def may_be_drawn(path: Path, declared: PortType, files_of: FilesOf) -> bool:
    """Whether values of a type may have to be drawn: the suffix is a picture's and not one that the type writes."""
    known = _own_suffixes(declared, files_of)
    suffix = path.suffix.lower()
    return suffix in PICTURE_SUFFIXES and (known is None or suffix not in known or declared.optional)


def is_drawn(value: Any, declared: PortType, path: Path, files_of: FilesOf) -> bool:
    """Whether a value is written as its picture: its type has no writer of its own for that suffix."""
    if path.suffix.lower() not in PICTURE_SUFFIXES:
        return False
    files = _files(value, declared, files_of)
    return files is None or (files.suffixes != () and path.suffix.lower() not in files.suffixes)


def _own_suffixes(declared: PortType, files_of: FilesOf) -> list[str] | None:
    """What a type is written as, and .npz; None where only its writer can tell."""
    known: list[str] = []
    for atom in declared.alternatives:
        files = files_of(atom)
        suffixes = files.suffixes if files is not None and files.write is not None else None
        if atom is object or suffixes == ():
            return None
        known += suffixes or ()
        known += [".npy"] if _is_array(atom) else []
    return [*known, ".npz"]


def make_folder(folder: Path) -> None:
    """Make a folder for results, where there is none.

    Raises:
        RefusedOutput: a file has its name, or it cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = "is a file; name a folder for the results" if folder.is_file() else error.strerror or str(error)
        raise RefusedOutput(folder, reason) from None


@contextmanager
def beside(path: Path) -> Iterator[Path]:
    """A temporary path in the same folder that takes the place of `path` when the block succeeds.

    Raises:
        UnwritableFile: the folder cannot be made or written to.
    """
    _make_folder_of(path)
    place = Path(os.path.realpath(path))  # a link is written through; its own suffix says what is written
    unfinished = place.with_name(f".{path.stem[:100]}-{secrets.token_hex(4)}{path.suffix}")
    try:
        os.close(create(str(unfinished)))
    except OSError as error:
        raise UnwritableFile(path, f"cannot write into the folder: {error.strerror}") from None
    with replacing(str(place), str(unfinished)):
        yield unfinished


def _make_folder_of(path: Path) -> None:
    folder = Path(os.path.realpath(path)).parent
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UnwritableFile(path, f"its folder cannot be made: {error.strerror}") from None


def _write_with(path: Path, write: Callable[[Path], None]) -> None:
    try:
        with beside(path) as temporary:
            write(temporary)
    except OSError as error:
        raise UnwritableFile(path, error.strerror or str(error)) from None


def _files(value: Any, declared: PortType, files_of: FilesOf) -> Files | None:
    """Who writes a value: the array type that the port declares and that it is of, or its class."""
    kinds: list[Atom] = [a for a in declared.alternatives if isinstance(a, ArrayType) and a.problem(value) is None]
    files = (files_of(kind) for kind in (*kinds, type(value)))
    return next((found for found in files if found is not None and found.write is not None), None)


def _is_array(atom: object) -> bool:
    return isinstance(atom, ArrayType) or (isinstance(atom, type) and issubclass(np.ndarray, atom))
