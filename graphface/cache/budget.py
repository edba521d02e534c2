"""Which entries of a disk cache go when there are too many: age, dear ones counting as younger.

The age that eviction goes by is the file's own mtime: the moment up to which the entry is worth keeping. Storing and
reading set it to now plus a credit, which grows with the seconds of computing that a MiB of the entry saves. Evicting
then means deleting the smallest mtimes: least recently used first, dear entries as if used up to a month later.
"""

from __future__ import annotations

import threading
import time

from graphface.cache.folder import Folder
from graphface.values.whole_file import delete

CREDIT_S = 86_400.0
"""How much later an entry is evicted for each second of computing that one MiB of it saves: a day."""

CREDIT_LIMIT_S = 30 * CREDIT_S

_EVICT_TO = 0.9
_RESCAN_S = 60.0
"""Other processes fill the folder too, so its size is counted anew this often."""


def keep_until(cost_seconds: float, size: int) -> float:
    """The mtime of an entry of `size` bytes that is used now, and took `cost_seconds` to compute."""
    saved_per_mib = cost_seconds * (1 << 20) / max(size, 1 << 12)
    return time.time() + min(CREDIT_LIMIT_S, CREDIT_S * saved_per_mib)


class Room:
    """The bytes that the entries of a folder may take together."""

    def __init__(self, folder: Folder, budget_bytes: int) -> None:
        self._folder = folder
        self._budget = budget_bytes
        self._lock = threading.Lock()
        self._taken: int | None = None
        self._counted_at = 0.0

    def taken(self, added: int) -> int:
        """Note that `added` bytes were stored; where that is too much, evict down to nine tenths. How many went."""
        with self._lock:
            now = time.monotonic()
            self._taken = None if self._taken is None or now - self._counted_at > _RESCAN_S else self._taken + added
            if self._taken is not None and self._taken <= self._budget:
                return 0
            files = sorted(self._folder.entries(), key=lambda entry: entry.keep_until)
            self._taken = sum(entry.size for entry in files)
            self._counted_at = now
            self._folder.delete_strays()
            evicted, limit = 0, float(self._budget)
            for entry in files:
                if self._taken <= limit:
                    break
                delete(entry.path)
                self._taken -= entry.size
                evicted, limit = evicted + 1, self._budget * _EVICT_TO
            return evicted

    def forget(self) -> None:
        """Count anew at the next occasion."""
        with self._lock:
            self._taken = None
