"""The memory tier: memoized values under a budget in bytes.

An array is counted once however many values hold it (a node that passes its photo on costs nothing), and what is
dropped first is what is cheapest to compute again per byte held, among equals the longest unused. Ranking happens only
when the budget is exceeded, over all entries at once and down to 90 %, so that a hit or a put costs a dictionary
operation.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from typing import Any

import numpy as np

from graphface.cache.give_back import give_back_freed
from graphface.settings import memory_budget

MISSING = object()
_ENTRY_BYTES = 200
_DROP_TO = 0.9
_EVICTIONS_KNOWN = 4096
"""How many keys are remembered as evicted: some tens of runs of a large graph, in half a megabyte."""
_GIVE_BACK_SHARE = 0.25
_GIVE_BACK_BYTES = 64 << 20
"""An eviction is given back to the system where it frees this share of the budget, and so many bytes."""


_Held = list[Any]
_VALUE, _SECONDS, _ARRAYS, _USED = range(4)
"""An entry: the value, the seconds it took to compute, the buffers it holds, when it was last used.

A list, since most values are numbers, and making an object would cost more than all the rest of keeping one."""


class MemoryTier:
    """Values by key; safe to share between threads.

    Args:
        budget: bytes of array data to hold at the most; a value larger than this is not kept. By default what the user
            has set (`graphface.settings`), or 2 GiB.

    Raises:
        UsageError: what the user has set is no size.
    """

    def __init__(self, budget: int | None = None) -> None:
        self.budget: int = budget if budget is not None else memory_budget()
        self._array_bytes = 0
        self._held: dict[bytes, _Held] = {}
        self._holders: dict[int, int] = {}
        self._evicted: OrderedDict[bytes, None] = OrderedDict()
        self._clock = 0
        self._lock = threading.Lock()

    def __len__(self) -> int:
        return len(self._held)

    @property
    def held_bytes(self) -> int:
        """What is held: the buffers, each once, and a little for every entry."""
        return self._array_bytes + _ENTRY_BYTES * len(self._held)

    def __contains__(self, key: bytes) -> bool:
        return key in self._held

    def get(self, key: bytes) -> Any:
        """The value, or `MISSING`."""
        held = self._held.get(key)
        if held is None:
            return MISSING
        self._clock = held[_USED] = self._clock + 1
        return held[_VALUE]

    def put(self, key: bytes, value: Any, seconds: float, arrays: tuple[np.ndarray, ...] = ()) -> None:
        """Keep a value that took `seconds` to compute; `arrays` are the buffers it holds (`freeze`)."""
        self._clock = used = self._clock + 1
        if not arrays:  # one dictionary operation, which needs no lock
            self._held.setdefault(key, [value, seconds, arrays, used])
        elif sum(a.nbytes for a in arrays) <= self.budget:
            with self._lock:
                if key not in self._held:
                    self._held[key] = [value, seconds, arrays, used]
                    self._count(arrays)
        if self._array_bytes + _ENTRY_BYTES * len(self._held) > self.budget:
            self._make_room(key)

    def drop(self, key: bytes) -> None:
        """Forget a value, if it is held."""
        with self._lock:
            if key in self._held:
                self._drop(key)

    def clear(self) -> None:
        """Forget everything, and give the memory back to the system where that is possible."""
        with self._lock:
            for key in list(self._held):
                self._note_evicted(key)
            self._held.clear()
            self._holders.clear()
            self._array_bytes = 0
        give_back_freed()

    def was_evicted(self, key: bytes) -> bool:
        """Whether the value was held and had to go; the last few thousand evictions are known."""
        return key in self._evicted

    def _count(self, arrays: tuple[np.ndarray, ...]) -> None:
        for array in arrays:
            holders = self._holders.get(id(array), 0)
            self._holders[id(array)] = holders + 1
            if not holders:
                self._array_bytes += array.nbytes

    def _make_room(self, newest: bytes) -> None:
        """Drop entries, least worth first, until under the mark; the newest stays if it can."""
        with self._lock:
            before, held = self.held_bytes, dict(self._held)
            for key in sorted(held, key=lambda k: (k == newest, self._worth(held[k]), held[k][_USED])):
                if self.held_bytes <= self.budget * _DROP_TO:
                    break
                self._drop(key)
            freed = before - self.held_bytes
        if freed > max(_GIVE_BACK_BYTES, self.budget * _GIVE_BACK_SHARE):
            give_back_freed()

    def _worth(self, held: _Held) -> float:
        """Seconds saved per byte held; those who hold an array together share its bytes.

        Counting a shared byte as not freed at all would keep for ever what two cheap nodes hold.
        """
        return held[_SECONDS] / (_ENTRY_BYTES + sum(a.nbytes / self._holders[id(a)] for a in held[_ARRAYS]))  # type: ignore[no-any-return]

    def _drop(self, key: bytes) -> None:
        arrays = self._held.pop(key)[_ARRAYS]
        self._note_evicted(key)
        for array in arrays:
            self._holders[id(array)] -= 1
            if self._holders[id(array)] == 0:
                del self._holders[id(array)]
                self._array_bytes -= array.nbytes

    def _note_evicted(self, key: bytes) -> None:
        self._evicted[key] = None
        self._evicted.move_to_end(key)
        if len(self._evicted) > _EVICTIONS_KNOWN:
            self._evicted.popitem(last=False)
