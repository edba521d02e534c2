"""One value in a file, all of it: `run --dump` writes it; `--pin`, the debugger and `diff --golden` read it.

The file is an .npz, readable by NumPy alone: its arrays under the names "0", "1", ..., and under "structure" what they
are parts of, as JSON (`graphface.values.codec`). Nothing in it is code, and nothing is lost.
"""

from __future__ import annotations

import json
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from graphface.errors import UnreadableFile, UnwritableFile
from graphface.values.codec import CodecError, decode, encode
from graphface.values.writing import beside

STRUCTURE = "structure"
"""The name of the entry that is no array of the value."""


def is_value_file(path: Path) -> bool:
    """Whether a file was written by `write_value`, as far as its table of contents tells."""
    try:
        with zipfile.ZipFile(path) as held:
            return f"{STRUCTURE}.npy" in held.namelist()
    except (OSError, zipfile.BadZipFile):
        return False


def write_value(value: Any, path: Path) -> None:
    """Write a value, all of it, to an .npz; whole or not at all.

    Raises:
        UnwritableFile: some part of the value is of no kind that can be stored, or the folder refuses.
    """
    try:
        tensors, structure = encode(value)
    except CodecError as error:
        raise UnwritableFile(path, str(error)) from None
    words = np.array(json.dumps(structure, separators=(",", ":")))
    try:
        with beside(path) as temporary, zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as held:
            for name, array in {STRUCTURE: words, **tensors}.items():
                with held.open(f"{name}.npy", "w", force_zip64=True) as entry:
                    np.lib.format.write_array(entry, array, allow_pickle=False)
    except OSError as error:
        raise UnwritableFile(path, error.strerror or str(error)) from None


def read_value(path: Path, annotation: Any) -> Any:
    """A value as `write_value` wrote it, its arrays read-only.

    Args:
        annotation: what its operator returns (`Operator.output_annotation`); only classes that it names are built.

    Raises:
        UnreadableFile: there is no such file, or it holds no value of that type.
    """
    try:
        with np.load(path, allow_pickle=False) as held:
            tensors = {name: held[name] for name in held.files}
        structure = json.loads(str(tensors.pop(STRUCTURE)))
        return decode(tensors, structure, annotation)
    except FileNotFoundError:
        raise UnreadableFile(path, "no such file") from None
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        reason = f"it is no value as --dump writes it ({type(error).__name__}: {error})"
        raise UnreadableFile(path, reason) from None
