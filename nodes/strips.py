"""Pictures worked on a few rows at a time, by several threads.

Arithmetic on whole pictures waits for memory: each operation reads and writes tens of megabytes. A strip and several
temporaries of its size stay in the processor's cache, which alone makes it twice as fast, and NumPy and OpenCV let
other threads run meanwhile.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

_VALUES = 1 << 16
"""Values of a strip: several arrays of 256 KB."""

_THREADS = min(4, os.cpu_count() or 1)


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
    strips = [slice(top, top + step) for top in range(0, height, step)]
    if len(strips) < 2 or _THREADS < 2:
        for rows in strips:
            work(rows)
        return
    with ThreadPoolExecutor(_THREADS) as pool:
        list(pool.map(work, strips))
