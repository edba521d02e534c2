"""The disk tier: memoized values in a folder, shared by any number of processes, killed at any moment.

One file per entry and nothing else: no index, no lock, no database, hence nothing that can disagree with the files.
`graphface.cache.folder` says which files these are, `graphface.values.whole_file` how they are written, `entry` what
stands in one, and `budget` which go when there are too many. Every read verifies the checksum: what is damaged,
truncated or not ours is dropped, reported and computed again.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from graphface.cache.budget import Room, keep_until
from graphface.cache.entry import DamagedEntry, UnknownChecksum, header_length, pack, read_header, unpack
from graphface.cache.folder import Folder
from graphface.cache.memory import MISSING
from graphface.errors import UsageError
from graphface.fallback import warn
from graphface.values.codec import CodecError, decode, encode
from graphface.values.whole_file import NO_FOLLOW, date, delete, read, write


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


class DiskTier:
    """Memoized values in `folder`, which is made when first needed.

    Args:
        budget_bytes: what the entries may take; a value larger than that is not stored.
        report: told in a sentence about everything dropped or not stored; by default `graphface.warn`.

    Raises:
        UsageError: `folder` holds files and is not a cache of graphface, is no folder, or cannot be looked into.
    """

    def __init__(self, folder: Path | str, budget_bytes: int, report: Callable[[str], None] = warn) -> None:
        self.folder: Path = Path(folder)
        self.budget_bytes = budget_bytes
        self._report = report
        self._files = Folder(self.folder)
        self._room = Room(self._files, budget_bytes)
        self._counters = {"hits": 0, "misses": 0, "stored": 0, "evicted": 0, "dropped": 0}
        try:
            foreign = self._files.foreign()
        except OSError as error:
            raise UsageError(f"{self.folder} cannot be used as a cache: {error.strerror or error}") from None
        if foreign:
            raise UsageError(f"{self.folder} is not a cache of graphface; name a new or an empty folder")

    def get(self, key: bytes, annotation: Any) -> Any:
        """The value stored under `key`, its arrays read-only, or `MISSING`; see `codec.decode` for `annotation`."""
        path = self._files.entry(key)
        try:
            data, descriptor = read(path)
        except FileNotFoundError:
            return self._missing()
        except (OSError, MemoryError) as error:
            reason = error.strerror if isinstance(error, OSError) else "out of memory"
            self._report(f"cache entry {path} cannot be read ({reason}); computing it again")
            return self._missing()
        try:
            tensors, structure, meta = unpack(memoryview(data), key)
            value = decode(tensors, structure, annotation)
            date(descriptor, keep_until(meta["cost_seconds"], data.nbytes))
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
        path = self._files.entry(key)
        about = {"cost_seconds": max(0.0, float(cost_seconds)), "written": time.time()} | (meta or {})
        try:
            tensors, structure = encode(value)
            if annotation is not None:
                decode(tensors, structure, annotation)
            buffers = pack(tensors, structure, key, about)
        except (CodecError, TypeError, ValueError, RecursionError, MemoryError) as error:
            self._report(f"a value of type {type(value).__qualname__} is not cached on disk: {error}")
            return False
        size = sum(len(buffer) for buffer in buffers)
        if size > self.budget_bytes:
            self._report(f"a value of {size} bytes is not cached on disk: the budget is {self.budget_bytes} bytes")
            return False
        try:
            self._files.prepare(os.path.dirname(path))
            write(path, self._files.unfinished(key), buffers, keep_until(about["cost_seconds"], size))
        except OSError as error:
            self._report(f"the disk cache {self.folder} cannot be written ({error.strerror or error}); not stored")
            return False
        self._counters["stored"] += 1
        self._counters["evicted"] += self._room.taken(size)
        return True

    def contains(self, key: bytes) -> bool:
        """Whether there is an entry for `key`; whether it is intact, only `get` finds out."""
        return os.path.isfile(self._files.entry(key))

    def meta(self, key: bytes) -> dict[str, Any] | None:
        """What `put` was told about the entry, with `cost_seconds` and `written`; not verified. None without entry."""
        try:
            with open(os.open(self._files.entry(key), os.O_RDONLY | NO_FOLLOW), "rb") as file:
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
        files = list(self._files.entries())
        return DiskStats(self.folder, len(files), sum(f.size for f in files), self.budget_bytes, **self._counters)

    def clear(self) -> int:
        """Delete every entry and unfinished write; how many bytes that freed.

        Raises:
            UsageError: the folder does not carry our mark.
        """
        if not self.folder.exists():
            return 0
        if not self._files.marked():
            raise UsageError(f"{self.folder} is not a cache of graphface; nothing was deleted")
        freed = self._files.clear()
        self._room.forget()
        return freed

    def verify(self, *, drop: bool = False) -> VerifyReport:
        """Read every entry and compare checksums; with `drop`, delete the damaged ones and old unfinished writes."""
        found = VerifyReport()
        for path, kind in self._files.files():
            if kind == "foreign":
                found.foreign.append(Path(path))
            elif kind == "unfinished":
                found.unfinished.append(Path(path))
            else:
                self._verify_entry(path, found)
        if drop:
            for damaged, _ in found.damaged:
                self._counters["dropped"] += bool(delete(str(damaged)))
            self._files.delete_strays()
        return found

    def _verify_entry(self, path: str, found: VerifyReport) -> None:
        try:
            data, descriptor = read(path)
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

    def _drop(self, path: str, reason: str) -> None:
        self._counters["dropped"] += 1
        delete(path)
        self._report(f"cache entry {path} dropped: {reason}; computing it again")

    def _missing(self) -> Any:
        self._counters["misses"] += 1
        return MISSING
