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


class _Held:
    """A value with what it took to compute, the buffers it holds, and when it was last used."""

    __slots__ = ("arrays", "seconds", "used", "value")

    def __init__(self, value: Any, seconds: float, arrays: tuple[np.ndarray, ...], used: int) -> None:
        self.value = value
        self.seconds = seconds
        self.arrays = arrays
        self.used = used


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
        self.bytes: int = 0
        self._held: dict[bytes, _Held] = {}
        self._holders: dict[int, int] = {}
        self._evicted: OrderedDict[bytes, None] = OrderedDict()
        self._clock = 0
        self._lock = threading.Lock()

    def __len__(self) -> int:
        return len(self._held)

    def __contains__(self, key: bytes) -> bool:
        return key in self._held

    def get(self, key: bytes) -> Any:
        """The value, or `MISSING`."""
        held = self._held.get(key)
        if held is None:
            return MISSING
        self._clock = held.used = self._clock + 1
        return held.value

    def put(self, key: bytes, value: Any, seconds: float, arrays: tuple[np.ndarray, ...] = ()) -> None:
        """Keep a value that took `seconds` to compute; `arrays` are the buffers it holds (`freeze`)."""
        if arrays and sum(a.nbytes for a in arrays) > self.budget:
            return
        freed = 0
        with self._lock:
            if key in self._held:
                return
            self._clock += 1
            self._held[key] = _Held(value, seconds, arrays, self._clock)
            self.bytes += _ENTRY_BYTES
            for array in arrays:
                holders = self._holders.get(id(array), 0)
                self._holders[id(array)] = holders + 1
                if not holders:
                    self.bytes += array.nbytes
            if self.bytes > self.budget:
                before = self.bytes
                self._shrink(key)
                freed = before - self.bytes
        if freed > max(_GIVE_BACK_BYTES, self.budget * _GIVE_BACK_SHARE):
            give_back_freed()

    def drop(self, key: bytes) -> None:
        """Forget a value, if it is held."""
        with self._lock:
            if key in self._held:
                self._drop(key)

    def clear(self) -> None:
        """Forget everything, and give the memory back to the system where that is possible."""
        with self._lock:
            for key in self._held:
                self._note_evicted(key)
            self._held.clear()
            self._holders.clear()
            self.bytes = 0
        give_back_freed()

    def was_evicted(self, key: bytes) -> bool:
        """Whether the value was held and had to go; the last few thousand evictions are known."""
        return key in self._evicted

    def _shrink(self, newest: bytes) -> None:
        """Drop entries, least worth first, until under the mark; the newest stays if it can."""
        ranked = sorted(self._held, key=lambda k: (k == newest, self._worth(self._held[k]), self._held[k].used))
        for key in ranked:
            if self.bytes <= self.budget * _DROP_TO:
                break
            self._drop(key)

    def _worth(self, held: _Held) -> float:
        """Seconds saved per byte held; those who hold an array together share its bytes.

        Counting a shared byte as not freed at all would keep for ever what two cheap nodes hold.
        """
        return held.seconds / (_ENTRY_BYTES + sum(a.nbytes / self._holders[id(a)] for a in held.arrays))

    def _drop(self, key: bytes) -> None:
        arrays = self._held.pop(key).arrays
        self._note_evicted(key)
        self.bytes -= _ENTRY_BYTES
        for array in arrays:
            self._holders[id(array)] -= 1
            if self._holders[id(array)] == 0:
                del self._holders[id(array)]
                self.bytes -= array.nbytes

    def _note_evicted(self, key: bytes) -> None:
        self._evicted[key] = None
        self._evicted.move_to_end(key)
        if len(self._evicted) > _EVICTIONS_KNOWN:
            self._evicted.popitem(last=False)
