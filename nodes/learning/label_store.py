"""Training pictures of photographs, kept in a folder: MediaPipe's network labels each photograph once."""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from graphface import UnreadableFile
from graphface.fingerprint import fingerprint
from graphface.nodes.learning.label_pictures import TrainingPicture, photo_pictures
from graphface.nodes.types import Landmarks
from graphface.values.writing import beside, make_folder

_MAPS = ("pixels", "inside", "labels", "person", "plate")


def kept_pictures(paths: Sequence[Path], folder: Path | None) -> Iterator[TrainingPicture]:
    """The training picture of each photograph with a face; what is in `folder` is not made again.

    Each is kept under a name that changes with the photograph's bytes and with the code that labels it. So a run that
    was stopped goes on where it was.
    """
    from rich.progress import track

    if folder is not None:
        make_folder(folder)
        version = fingerprint(photo_pictures).digest
    for path in track(paths, description="photographs", disable=not sys.stderr.isatty()):
        if folder is None:
            yield from photo_pictures([path])
            continue
        own = folder / f"{path.stem}-{hashlib.sha256(version + path.read_bytes()).hexdigest()[:12]}.npz"
        if own.exists():
            yield read_picture(own)
            continue
        for picture in photo_pictures([path]):
            write_picture(picture, own)
            yield picture


def write_picture(picture: TrainingPicture, path: Path) -> None:
    """Write a training picture as .npz, whole or not at all.

    Raises:
        UnwritableFile: the folder refuses.
    """
    maps = {name: getattr(picture, name) for name in _MAPS}
    with beside(path) as unfinished:
        np.savez_compressed(
            unfinished,
            name=np.array(picture.name),
            points=picture.landmarks.points,
            scheme=np.array(picture.landmarks.scheme),
            **maps,
        )


def read_picture(path: Path) -> TrainingPicture:
    """A training picture as `write_picture` wrote it.

    Raises:
        UnreadableFile: it is missing or damaged.
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            landmarks = Landmarks(file["points"], str(file["scheme"]))
            return TrainingPicture(name=str(file["name"]), landmarks=landmarks, **{name: file[name] for name in _MAPS})
    except (OSError, ValueError, EOFError, KeyError) as error:
        raise UnreadableFile(path, f"not a training picture: {error}") from error
