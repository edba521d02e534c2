"""Work on a picture a few rows at a time, by several threads.

Arithmetic on whole pictures waits for memory, because each operation reads and writes tens of megabytes. A strip of
rows and several temporary arrays of its size stay in the processor's cache, which alone is twice as fast. NumPy and
OpenCV release the interpreter's lock, so several strips are worked on at the same time.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import TypeVar

_VALUES = 1 << 18
"""Values in a strip: several arrays of 1 MB. A quarter is as fast for one thread, but two then wait for each other."""


_THREADS = min(4, os.cpu_count() or 1)


T = TypeVar("T")


def by_strips(work: Callable[[slice], None], shape: tuple[int, ...]) -> None:
    """Call `work` with the rows of each strip, in no certain order and from several threads; return when all are done.

    Args:
        work: reads and writes its own rows of arrays; must not depend on those of other strips.
        shape: of the largest array worked on, H x W or H x W x channels.

    Raises:
        Whatever `work` raises.

    >>> import numpy as np
    >>> picture, out = np.ones((4000, 600)), np.empty((4000, 600))
    >>> def double(rows):
    ...     out[rows] = 2 * picture[rows]
    >>> by_strips(double, picture.shape)
    >>> bool((out == 2).all())
    True
    """
    height, row = shape[0], 1
    for length in shape[1:]:
        row *= length
    step = max(1, _VALUES // max(row, 1))
    in_parallel(work, [slice(top, min(top + step, height)) for top in range(0, height, step)])


def in_parallel(work: Callable[[T], None], items: Iterable[T]) -> None:
    """Call `work` with each item, from this thread and from idle threads of a pool; return when all are done.

    The calling thread works too, so a `work` that calls `in_parallel` itself ends even if the whole pool is busy.

    Raises:
        Whatever `work` raises; the items that no thread has begun are then left out.

    >>> squares = {}
    >>> in_parallel(lambda n: squares.update({n: n * n}), range(4))
    >>> sorted(squares.items())
    [(0, 0), (1, 1), (2, 4), (3, 9)]
    """
    waiting = list(items)[::-1]

    def until_none_is_left() -> None:
        try:
            while waiting:
                try:
                    item = waiting.pop()  # atomic; another thread may have taken the last one
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
    """Kept for the next picture: to start threads takes as long as a strip."""
    return ThreadPoolExecutor(max(1, _THREADS - 1), thread_name_prefix="strips")


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_pool.cache_clear)  # threads do not survive a fork
