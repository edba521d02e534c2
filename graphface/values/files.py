"""How values become files and files values: said beside the types, not in them.

A type says what a value is. Who reads and writes files needs libraries that nobody else does, and so stands apart, in
`Pack.files` of an installed pack, in `FILES` of a plug-in file, or in a notebook through `Registry.add_files`:

    pack = Pack("mine", ..., types={"Curve": "mine.types:Curve"}, files={"Curve": "mine.files:CURVE"})

    CURVE = Files(read=read_curve, write=write_curve, suffixes=(".csv",))
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from graphface.values.port_types import Atom, PortType

Reader = Callable[[Path], Any]


@dataclass(frozen=True)
class Files:
    """How values of one type are read from and written to files.

    Args:
        read: from a path to a value: the type's graph inputs may then be given as files.
        write: from a value and a path; where it also takes `text=`, a mapping of words to keep inside the file, results
            carry their provenance. Both raise `UnreadableFile` or `UnwritableFile`, or OSError.
        suffixes: what `write` knows, such as (".png", ".jpg"): another is refused before anything runs. Without any,
            `write` is asked when the value is there.
        text: from a path to the words kept inside the file.
        check: from a path, before anything runs: raises UsageError where `write` could not write it here, because a
            package is missing, say.
    """

    read: Reader | None = None
    write: Callable[..., None] | None = None
    suffixes: tuple[str, ...] = ()
    text: Callable[[Path], dict[str, str]] | None = None
    check: Callable[[Path], None] | None = None


FilesOf = Callable[[Atom | PortType], Files | None]
"""The files of a type or a port, where it has any: `Registry.files`."""
