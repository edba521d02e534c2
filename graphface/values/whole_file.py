"""Files read and written as a whole: a reader sees all of one or nothing, whoever is killed on the way.

Nothing is synced to the device: after a power cut a file may hold garbage, which its checksum must catch. (fsync would
make a put of 12 MiB several times dearer, to save what can be computed again.)
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable, Iterator
from typing import Any

NO_FOLLOW = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0) | getattr(os, "O_CLOEXEC", 0)

_CHUNK = 1 << 20
"""Bytes for each system call: on ext4 a single write of 12 MiB took 3 to 45 ms, in chunks 3 to 7 ms."""


def read(path: str) -> tuple[Any, int]:
    """The bytes of a file in a fresh buffer, and its descriptor, still open.

    Raises:
        OSError: as `os.open`; also for a symbolic link or a file in a linked folder.
    """
    import numpy as np

    if os.path.islink(os.path.dirname(path)):
        raise OSError(40, "its folder is a symbolic link")
    descriptor = os.open(path, os.O_RDONLY | NO_FOLLOW)
    try:
        data = np.empty(os.fstat(descriptor).st_size, np.uint8)
        view, position = memoryview(data.data), 0
        with open(descriptor, "rb", buffering=0, closefd=False) as file:
            while position < len(view) and (got := file.readinto(view[position : position + _CHUNK])):
                position += got
        return data[:position], descriptor
    except BaseException:
        os.close(descriptor)
        raise


def write(path: str, unfinished: str, buffers: Iterable[Any], modified: float) -> None:
    """Write `buffers` to the new file `unfinished`, date it, and rename it to `path`.

    Raises:
        OSError: it cannot be written; then nothing is left of it.
    """
    descriptor = create(unfinished)
    with replacing(path, unfinished):
        try:
            for buffer in buffers:
                _write_all(descriptor, memoryview(buffer))
            date(descriptor, modified)
        finally:
            os.close(descriptor)


def create(path: str) -> int:
    """A file that was not there before, open for writing, with the mode that the user's umask asks for.

    Raises:
        OSError: it cannot be made.
    """
    return os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | NO_FOLLOW, 0o666)


@contextlib.contextmanager
def replacing(path: str, unfinished: str) -> Iterator[None]:
    """When the block succeeds, the file `unfinished` takes the place of `path`; otherwise it is deleted."""
    try:
        yield
        os.replace(unfinished, path)
    except BaseException:
        delete(unfinished)
        raise


def date(descriptor: int, modified: float) -> None:
    """Set the mtime of an open file, where that is allowed: a read-only cache serves all the same."""
    with contextlib.suppress(OSError, NotImplementedError):
        os.utime(descriptor, (modified, modified))


def delete(path: str) -> int:
    """Delete a file; its size, or 0 where it could not be deleted."""
    try:
        size = os.lstat(path).st_size
        os.unlink(path)
    except OSError:
        return 0
    return size


def _write_all(descriptor: int, data: memoryview) -> None:
    while data:
        data = data[os.write(descriptor, data[:_CHUNK]) :]
