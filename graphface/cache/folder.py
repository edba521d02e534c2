"""The folder of a disk cache: what it looks like, and which files in it are ours.

    CACHEDIR.TAG                        our mark
    3f/3f0a…e1.safetensors              an entry, in the shard that its key begins with
    3f/.3f0a…e1.1234.5671.tmp           an unfinished write

Only a folder that carries our mark is used, and in it only files named like entries or like our unfinished writes are
ever deleted. Symbolic links are not followed.
"""

from __future__ import annotations

import os
import re
import threading
import time
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from typing import Literal, NamedTuple

from graphface.values.whole_file import delete, replacing

MARK = "CACHEDIR.TAG"
"""The name that backup programs know to skip (bford.info/cachedir), and the sign that the folder is ours."""

STRAY_AFTER_S = 3600.0
"""An unfinished write this old belongs to a process that was killed."""

_MARK_TEXT = (
    "Signature: 8a477f597d28d172789f06886806bc55\n"
    "# This folder is a cache of graphface (format 1): everything in it can be computed again.\n"
    "# `graphface cache clear` empties it.\n"
)
_ENTRY = re.compile(r"[0-9a-f]{32}\.safetensors")
_UNFINISHED = re.compile(r"\.[0-9a-f]{32}\.\d+\.\d+\.tmp")
_SHARD = re.compile(r"[0-9a-f]{2}")

Kind = Literal["entry", "unfinished", "foreign"]


class Entry(NamedTuple):
    """`keep_until` is the file's mtime: see `graphface.cache.budget`."""

    path: str
    size: int
    keep_until: float


class Folder:
    """The cache in `path`, which need not exist yet."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._numbers = count()
        self._prepared = False

    def entry(self, key: bytes) -> str:
        """Where the entry of a key lies."""
        name = key.hex()
        if len(name) != 32:
            raise ValueError(f"a key has 16 bytes, this one has {len(key)}")
        return os.path.join(self.path, name[:2], f"{name}.safetensors")

    def unfinished(self, key: bytes) -> str:
        """A name beside that place, which no other write of any process has."""
        writer = f"{os.getpid()}.{threading.get_ident() % 1000}{next(self._numbers)}"
        return os.path.join(os.path.dirname(self.entry(key)), f".{key.hex()}.{writer}.tmp")

    def foreign(self) -> bool:
        """Whether the folder is somebody else's.

        Another process may be making it ours at this moment: it drafts the mark, marks, and only then stores. So drafts
        do not count, and the mark is looked for after what else there is.
        """
        if not self.path.exists():
            return False
        if not self.path.is_dir():
            return True
        return any(not item.name.startswith(f"{MARK}.") for item in self.path.iterdir()) and not self.marked()

    def marked(self) -> bool:
        """Whether the mark is ours; one that a full disk or a power cut left empty is, where all beside it looks it."""
        text = self._mark()
        if text is None or text.startswith(_MARK_TEXT[:90]):
            return text is not None
        return _MARK_TEXT.startswith(text.rstrip("\0")) and all(
            _SHARD.fullmatch(item.name) or item.name in (MARK, "history") or item.name.startswith(f"{MARK}.")
            for item in _scan(self.path)
        )

    def _mark(self) -> str | None:
        try:
            return (self.path / MARK).read_text("utf-8", "replace")
        except OSError:
            return None

    def prepare(self, shard: str) -> None:
        """Make the folder, its mark and the shard, where they are missing.

        Raises:
            OSError: one cannot be made, or the shard is a symbolic link.
        """
        if os.path.islink(shard):
            raise OSError(f"{shard} is a symbolic link")
        if self._prepared and os.path.isdir(shard):
            return
        self.path.mkdir(parents=True, exist_ok=True)
        self._prepared = True
        if self._mark() != _MARK_TEXT:
            # Renamed into place like an entry: a mark cut short would lock the folder for good.
            draft = self.path / f"{MARK}.{os.getpid()}.{threading.get_ident()}"
            with replacing(str(self.path / MARK), str(draft)):
                draft.write_text(_MARK_TEXT, "utf-8")
        os.makedirs(shard, exist_ok=True)

    def files(self) -> Iterator[tuple[str, Kind]]:
        """Every file of the shards; an entry lies in its own shard and is no link."""
        for shard in self._shards():
            for item in _scan(shard):
                ours = item.is_file(follow_symlinks=False)
                name = item.name
                if ours and _ENTRY.fullmatch(name) and name[:2] == os.path.basename(shard):
                    yield item.path, "entry"
                else:
                    yield item.path, "unfinished" if ours and _UNFINISHED.fullmatch(name) else "foreign"

    def entries(self) -> Iterator[Entry]:
        for path, kind in self.files():
            if kind == "entry":
                try:
                    status = os.lstat(path)
                except OSError:
                    continue
                yield Entry(path, status.st_size, status.st_mtime)

    def clear(self) -> int:
        """Delete every entry and unfinished write; how many bytes that freed."""
        freed = sum(delete(path) for path, kind in self.files() if kind != "foreign")
        for shard in self._shards():
            try:
                os.rmdir(shard)
            except OSError:  # something that is not ours, or a process that is writing
                continue
        return freed

    def delete_strays(self) -> None:
        """Delete unfinished writes whose process was killed."""
        for path, kind in self.files():
            if kind == "unfinished":
                try:
                    old = time.time() - os.lstat(path).st_ctime > STRAY_AFTER_S
                except OSError:
                    continue
                if old:
                    delete(path)

    def _shards(self) -> list[str]:
        if not self.marked():
            return []
        found = (d for d in _scan(self.path) if _SHARD.fullmatch(d.name) and d.is_dir(follow_symlinks=False))
        return sorted(d.path for d in found)


def _scan(folder: Path | str) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as items:
            return list(items)
    except OSError:
        return []
