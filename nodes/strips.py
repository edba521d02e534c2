"""Pictures worked on a few rows at a time, by several threads.

Arithmetic on whole pictures waits for memory: each operation reads and writes tens of megabytes. A strip and several
temporaries of its size stay in the processor's cache, which alone makes it twice as fast, and NumPy and OpenCV let
other threads run meanwhile.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import TypeVar

_VALUES = 1 << 18
"""Values of a strip: several arrays of 1 MB. A quarter is as fast for one thread, but two then wait for each other."""


_THREADS = min(4, os.cpu_count() or 1)


T = TypeVar("T")


def by_strips(work: Callable[[slice], None], shape: tuple[int, ...]) -> None:
    """Call `work` with the rows of one strip after another, in no certain order, until all of `shape` is done.

    Args:
        work: reads and writes its own rows of arrays; must not depend on those of other strips.
        shape: of the largest array worked on, H x W or H x W x channels.

    Raises:
        Whatever `work` raises.
    """
    height, values = shape[0], 1
    for length in shape[1:]:
        values *= length
    step = max(1, _VALUES // max(values, 1))
    side_by_side(work, [slice(top, min(top + step, height)) for top in range(0, height, step)])


def side_by_side(work: Callable[[T], None], items: Iterable[T]) -> None:
    """Call `work` with each item, by this thread and by others that have nothing to do; done when all are.

    The calling thread works too, so this ends even where `work` itself calls it and every other thread is taken.

    Raises:
        Whatever `work` raises; items that nobody has begun are then left.
    """
    waiting = list(items)[::-1]

    def until_none_is_left() -> None:
        try:
            while waiting:
                try:
                    item = waiting.pop()  # atomic; another thread may have been faster
                except IndexError:
                    return
                work(item)
        except BaseException:
            waiting.clear()
            raise

    others = [_pool().submit(until_none_is_left) for _ in range(min(_THREADS, len(waiting)) - 1)]
    try:
        until_none_is_left()
    finally:
        # One that has not begun would find nothing left to do.
        failures = [other.exception() for other in others if not other.cancel()]
    for failure in failures:
        if failure is not None:
            raise failure


@cache
def _pool() -> ThreadPoolExecutor:
    """Kept for the next picture: starting threads costs as much as a strip."""
    return ThreadPoolExecutor(max(1, _THREADS - 1), thread_name_prefix="strips")


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_pool.cache_clear)  # threads do not survive a fork
