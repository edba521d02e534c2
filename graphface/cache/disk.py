"""The disk tier: memoized values in a folder, shared by any number of processes, killed at any moment.

One file per entry and nothing else: no index, no lock, no database, hence nothing that can disagree with the files.

- An entry is written beside its place and renamed into it, so a reader sees all of it or none. Nothing is synced to the
  device: after a power cut an entry may hold garbage, which its checksum catches. (fsync would make a 12 MiB put
  several times dearer, to save what can be computed again.)
- Every read verifies the checksum. What is damaged, truncated or not ours is dropped, reported and computed again.
- The age that eviction goes by is the file's own mtime: the moment up to which the entry is worth keeping. Storing and
  reading set it to now plus a credit, which grows with the seconds of computing that a MiB of the entry saves. Evicting
  then means deleting the smallest mtimes: least recently used first, dear entries as if used up to a month later.
- Only a folder that carries our mark is used, and in it only files named like entries or like our unfinished writes are
  ever deleted. Symbolic links are not followed.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from graphface.cache.codec import CodecError, decode, encode
from graphface.cache.entry import DamagedEntry, UnknownChecksum, header_length, pack, read_header, unpack
from graphface.cache.memory import MISSING
from graphface.errors import UsageError
from graphface.fallback import warn

MARK = "CACHEDIR.TAG"
"""The name that backup programs know to skip (bford.info/cachedir), and the sign that the folder is ours."""

_MARK_TEXT = (
    "Signature: 8a477f597d28d172789f06886806bc55\n"
    "# This folder is a cache of graphface (format 1): everything in it can be computed again.\n"
    "# `graphface cache clear` empties it.\n"
)
_ENTRY = re.compile(r"[0-9a-f]{32}\.safetensors")
_UNFINISHED = re.compile(r"\.[0-9a-f]{32}\.\d+\.\d+\.tmp")
_SHARD = re.compile(r"[0-9a-f]{2}")
_NO_FOLLOW = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0) | getattr(os, "O_CLOEXEC", 0)

STRAY_AFTER_S = 3600.0
"""An unfinished write this old belongs to a process that was killed."""

CREDIT_S = 86_400.0
"""How much later an entry is evicted for each second of computing that one MiB of it saves: a day."""

CREDIT_LIMIT_S = 30 * CREDIT_S

_CHUNK = 1 << 20
"""Bytes for each system call: on ext4 a single write of 12 MiB took 3 to 45 ms, in chunks 3 to 7 ms."""

_EVICT_TO = 0.9
_RESCAN_S = 60.0
"""Other processes fill the folder too, so its size is counted anew this often."""


@dataclass(frozen=True)
class DiskStats:
    """What the folder holds, and what this process did with it."""

    folder: Path
    entries: int
    bytes: int
    budget_bytes: int
    hits: int
    misses: int
    stored: int
    evicted: int
    dropped: int


@dataclass
class VerifyReport:
    """What `DiskTier.verify` found; `damaged` are (path, reason), `foreign` are paths that are not ours."""

    intact: int = 0
    bytes: int = 0
    damaged: list[tuple[Path, str]] = field(default_factory=list)
    unfinished: list[Path] = field(default_factory=list)
    foreign: list[Path] = field(default_factory=list)


class _File(NamedTuple):
    path: str
    size: int
    keep_until: float


class DiskTier:
    """Memoized values in `folder`, which is made when first needed.

    Args:
        budget_bytes: what the entries may take; a value larger than that is not stored.
        report: told in a sentence about everything dropped or not stored; by default `graphface.warn`.

    Raises:
        UsageError: `folder` holds files and is not a cache of graphface, or is no folder.
    """

    def __init__(self, folder: Path | str, budget_bytes: int, report: Callable[[str], None] = warn) -> None:
        self.folder = Path(folder)
        self.budget_bytes = budget_bytes
        self._report = report
        self._lock = threading.Lock()
        self._numbers = count()
        self._size: int | None = None
        self._counted_at = 0.0
        self._counters = {"hits": 0, "misses": 0, "stored": 0, "evicted": 0, "dropped": 0}
        if self.folder.exists() and self._foreign():
            raise UsageError(f"{self.folder} is not a cache of graphface; name a new or an empty folder")

    def get(self, key: bytes, annotation: Any) -> Any:
        """The value stored under `key`, its arrays read-only, or `MISSING`; see `codec.decode` for `annotation`."""
        path = self._path(key)
        try:
            data, descriptor = _read(path)
        except FileNotFoundError:
            return self._missing()
        except OSError as error:
            self._report(f"cache entry {path} cannot be read ({error.strerror}); computing it again")
            return self._missing()
        try:
            tensors, structure, meta = unpack(memoryview(data), key)
            value = decode(tensors, structure, annotation)
            self._touch(descriptor, _credit(meta["cost_seconds"], data.nbytes))
        except UnknownChecksum as error:
            self._report(f"cache entry {path} not used: {error}")
            return self._missing()
        except (DamagedEntry, CodecError, KeyError, TypeError, ValueError) as error:
            self._drop(path, str(error))
            return self._missing()
        finally:
            os.close(descriptor)
        self._counters["hits"] += 1
        return value

    def put(
        self,
        key: bytes,
        value: object,
        *,
        cost_seconds: float,
        meta: dict[str, Any] | None = None,
        annotation: Any = None,
    ) -> bool:
        """Store `value`; whether it was. What stands in the way is reported, never raised.

        Args:
            cost_seconds: what computing it took.
            meta: JSON-able, read back by `meta`.
            annotation: where given, it is made sure that `get` with it will give the value back.
        """
        about = {"cost_seconds": max(0.0, float(cost_seconds)), "written": time.time()} | (meta or {})
        try:
            tensors, structure = encode(value)
            if annotation is not None:
                decode(tensors, structure, annotation)
            buffers = pack(tensors, structure, key, about)
        except (CodecError, TypeError, ValueError, RecursionError) as error:
            self._report(f"a value of type {type(value).__qualname__} is not cached on disk: {error}")
            return False
        size = sum(len(buffer) for buffer in buffers)
        if size > self.budget_bytes:
            self._report(f"a value of {size} bytes is not cached on disk: the budget is {self.budget_bytes} bytes")
            return False
        try:
            self._write(key, buffers, _credit(about["cost_seconds"], size))
        except OSError as error:
            self._report(f"the disk cache {self.folder} cannot be written ({error.strerror or error}); not stored")
            return False
        self._counters["stored"] += 1
        self._make_room(size)
        return True

    def contains(self, key: bytes) -> bool:
        """Whether there is an entry for `key`; whether it is intact, only `get` finds out."""
        return os.path.isfile(self._path(key))

    def meta(self, key: bytes) -> dict[str, Any] | None:
        """What `put` was told about the entry, with `cost_seconds` and `written`; not verified. None without entry."""
        try:
            with open(os.open(self._path(key), os.O_RDONLY | _NO_FOLLOW), "rb") as file:
                front = file.read(256)
                front += file.read(max(0, 8 + header_length(front) - len(front)))
            found = json.loads(read_header(front)[0]["__metadata__"]["meta"])
            return found if isinstance(found, dict) else None
        except (OSError, DamagedEntry, ValueError):
            return None

    def cost(self, key: bytes) -> float:
        """The seconds that computing the entry took; 0 where there is none."""
        return float((self.meta(key) or {}).get("cost_seconds", 0.0))

    def stats(self) -> DiskStats:
        files = list(self._entries())
        return DiskStats(self.folder, len(files), sum(f.size for f in files), self.budget_bytes, **self._counters)

    def clear(self) -> int:
        """Delete every entry and unfinished write; how many bytes that freed.

        Raises:
            UsageError: the folder does not carry our mark.
        """
        if not self.folder.exists():
            return 0
        if not self._marked():
            raise UsageError(f"{self.folder} is not a cache of graphface; nothing was deleted")
        freed = 0
        for path, kind in self._files():
            if kind != "foreign":
                freed += _delete(path)
        for shard in self._shards():
            try:
                os.rmdir(shard)
            except OSError:  # something that is not ours, or a process that is writing
                continue
        with self._lock:
            self._size = None
        return freed

    def verify(self, *, drop: bool = False) -> VerifyReport:
        """Read every entry and compare checksums; with `drop`, delete the damaged ones and old unfinished writes."""
        found = VerifyReport()
        for path, kind in self._files():
            if kind == "foreign":
                found.foreign.append(Path(path))
            elif kind == "unfinished":
                found.unfinished.append(Path(path))
            else:
                self._verify_entry(path, found)
        if drop:
            for damaged, _ in found.damaged:
                self._counters["dropped"] += bool(_delete(str(damaged)))
            self._delete_strays()
        return found

    def _verify_entry(self, path: str, found: VerifyReport) -> None:
        try:
            data, descriptor = _read(path)
            os.close(descriptor)
            unpack(memoryview(data), bytes.fromhex(os.path.basename(path)[:32]))
        except FileNotFoundError:  # evicted meanwhile
            return
        except UnknownChecksum:
            pass
        except (DamagedEntry, OSError, ValueError, KeyError, TypeError) as error:
            found.damaged.append((Path(path), str(error)))
            return
        found.intact += 1
        found.bytes += data.nbytes

    def _path(self, key: bytes) -> str:
        name = key.hex()
        if len(name) != 32:
            raise ValueError(f"a key has 16 bytes, this one has {len(key)}")
        return os.path.join(self.folder, name[:2], f"{name}.safetensors")

    def _foreign(self) -> bool:
        """Whether the folder is somebody else's.

        Another process may be making it ours at this moment: it drafts the mark, marks, and only then stores. So drafts
        do not count, and the mark is looked for after what else there is.
        """
        if not self.folder.is_dir():
            return True
        return any(not item.name.startswith(f"{MARK}.") for item in self.folder.iterdir()) and not self._marked()

    def _marked(self) -> bool:
        try:
            return (self.folder / MARK).read_text("utf-8", "replace").startswith(_MARK_TEXT[:90])
        except OSError:
            return False

    def _write(self, key: bytes, buffers: list[Any], credit: float) -> None:
        path = self._path(key)
        shard = os.path.dirname(path)
        self._prepare(shard)
        number = next(self._numbers)
        unfinished = os.path.join(shard, f".{key.hex()}.{os.getpid()}.{threading.get_ident() % 1000}{number}.tmp")
        descriptor = os.open(unfinished, os.O_WRONLY | os.O_CREAT | os.O_EXCL | _NO_FOLLOW, 0o666)
        try:
            try:
                for buffer in buffers:
                    _write_all(descriptor, memoryview(buffer))
                self._touch(descriptor, credit)
            finally:
                os.close(descriptor)
            os.replace(unfinished, path)
        except BaseException:
            _delete(unfinished)
            raise

    def _prepare(self, shard: str) -> None:
        """Make the folder, its mark and the shard, where they are missing."""
        if os.path.islink(shard):
            raise OSError(f"{shard} is a symbolic link")
        if os.path.isdir(shard):
            return
        self.folder.mkdir(parents=True, exist_ok=True)
        if not self._marked():
            # Renamed into place like an entry: a mark cut short would lock the folder for good.
            draft = self.folder / f"{MARK}.{os.getpid()}.{threading.get_ident()}"
            draft.write_text(_MARK_TEXT, "utf-8")
            os.replace(draft, self.folder / MARK)
        os.makedirs(shard, exist_ok=True)

    def _touch(self, descriptor: int, credit: float) -> None:
        moment = time.time() + credit
        with contextlib.suppress(OSError, NotImplementedError):  # a read-only cache serves all the same
            os.utime(descriptor, (moment, moment))

    def _make_room(self, added: int) -> None:
        """Evict where the entries exceed the budget, down to nine tenths of it."""
        with self._lock:
            now = time.monotonic()
            self._size = None if self._size is None or now - self._counted_at > _RESCAN_S else self._size + added
            if self._size is not None and self._size <= self.budget_bytes:
                return
            files = sorted(self._entries(), key=lambda f: f.keep_until)
            self._size = sum(f.size for f in files)
            self._counted_at = now
            self._delete_strays()
            if self._size <= self.budget_bytes:
                return
            for file in files:
                if self._size <= self.budget_bytes * _EVICT_TO:
                    break
                _delete(file.path)
                self._size -= file.size
                self._counters["evicted"] += 1

    def _delete_strays(self) -> None:
        for path, kind in self._files():
            if kind == "unfinished":
                try:
                    old = time.time() - os.lstat(path).st_ctime > STRAY_AFTER_S
                except OSError:
                    continue
                if old:
                    _delete(path)

    def _drop(self, path: str, reason: str) -> None:
        self._counters["dropped"] += 1
        _delete(path)
        self._report(f"cache entry {path} dropped: {reason}; computing it again")

    def _missing(self) -> Any:
        self._counters["misses"] += 1
        return MISSING

    def _entries(self) -> Iterator[_File]:
        for path, kind in self._files():
            if kind == "entry":
                try:
                    status = os.lstat(path)
                except OSError:
                    continue
                yield _File(path, status.st_size, status.st_mtime)

    def _files(self) -> Iterator[tuple[str, str]]:
        """Every file of the shards, as "entry", "unfinished" or "foreign"; an entry lies in its own shard, unlinked."""
        for shard in self._shards():
            for item in _scan(shard):
                ours = item.is_file(follow_symlinks=False)
                name = item.name
                if ours and _ENTRY.fullmatch(name) and name[:2] == os.path.basename(shard):
                    yield item.path, "entry"
                else:
                    yield item.path, "unfinished" if ours and _UNFINISHED.fullmatch(name) else "foreign"

    def _shards(self) -> list[str]:
        if not self._marked():
            return []
        found = (d for d in _scan(self.folder) if _SHARD.fullmatch(d.name) and d.is_dir(follow_symlinks=False))
        return sorted(d.path for d in found)


def _scan(folder: Path | str) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as items:
            return list(items)
    except OSError:
        return []


def _credit(cost_seconds: float, size: int) -> float:
    """How much longer than its last use an entry is worth keeping, in seconds."""
    saved_per_mib = cost_seconds * (1 << 20) / max(size, 1 << 12)
    return min(CREDIT_LIMIT_S, CREDIT_S * saved_per_mib)


def _read(path: str) -> tuple[Any, int]:
    """The bytes of a file in a fresh buffer, and its descriptor, still open.

    Raises:
        OSError: as `os.open`; also for a symbolic link or a file in a linked shard.
    """
    if os.path.islink(os.path.dirname(path)):
        raise OSError(40, "its folder is a symbolic link")
    descriptor = os.open(path, os.O_RDONLY | _NO_FOLLOW)
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


def _write_all(descriptor: int, data: memoryview) -> None:
    while data:
        data = data[os.write(descriptor, data[:_CHUNK]) :]


def _delete(path: str) -> int:
    """Delete a file; its size, or 0 where it could not be deleted."""
    try:
        size = os.lstat(path).st_size
        os.unlink(path)
    except OSError:
        return 0
    return size
