"""Readers of face models in the files of their makers.

ICT-FaceKit (a folder of OBJ files, or packed), the Surrey face model (eos's binary form), FLAME and the Basel face
model (2009 and 2017). FLAME and Basel need a licence from their makers; none of their data is here.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from graphface import UnreadableFile, UsageError

if TYPE_CHECKING:
    from graphface.nodes.morphable.model import MorphableModel


KINDS = ("ict", "surrey", "flame", "basel")


def read_model(source: Path, kind: str = "", landmarks: Path | None = None) -> MorphableModel:
    """Read a model; see the module of its kind.

    Args:
        source: file or folder.
        kind: one of `KINDS`; guessed by default.
        landmarks: a file with lines "ibug number = vertex", where the source has no landmarks.

    Raises:
        UnreadableFile: it is not such a model.
        UsageError: an unknown kind, or a package that reading needs is missing.
    """
    from graphface.nodes.morphable.readers import basel, flame, ict, surrey

    source = Path(source)
    if not source.exists():
        raise UnreadableFile(source, "no such file or folder")
    readers = {"ict": ict.read_ict, "surrey": surrey.read_surrey, "flame": flame.read_flame, "basel": basel.read_basel}
    kind = kind or guess_kind(source)
    if kind not in readers:
        raise UsageError(f"unknown kind of face model {kind!r}; known: {', '.join(KINDS)}")
    return readers[kind](source, landmarks)


def guess_kind(source: Path) -> str:
    """The kind of a file or folder, by its suffix or content.

    Raises:
        UsageError: it looks like none.
    """
    source = Path(source)
    if source.is_dir():
        if any(source.glob("sfm_shape*.bin")):
            return "surrey"
        if any(source.rglob("identity000.obj")):
            return "ict"
    elif source.suffix == ".npz":
        return "ict"
    elif source.suffix == ".bin":
        return "surrey"
    elif source.suffix == ".pkl":
        return "flame"
    elif source.suffix in (".h5", ".hdf5", ".mat"):
        return "basel"
    raise UsageError(f"{source}: does not look like a known face model; choose one with --kind ({', '.join(KINDS)})")
