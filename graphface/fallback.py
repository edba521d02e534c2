"""`warn`: how a node says that it fell back on something, without failing.

Inside a run the sentence lands in the trace beside the node's name; outside, in a notebook or a test, it is an ordinary
Python warning. A context variable carries the collector, since `warnings.catch_warnings` is not thread-safe.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

collector: ContextVar[list[str] | None] = ContextVar("graphface_warnings", default=None)


class GraphfaceWarning(UserWarning):
    """Something works, but not as asked: a node fell back, a graph file uses an old name, a plug-in was left out."""


def warn(message: str) -> None:
    """Record that a fallback was taken: what was wrong, what was done instead."""
    collected = collector.get()
    if collected is None:
        warnings.warn(message, GraphfaceWarning, stacklevel=2)
    else:
        collected.append(message)


def collect_warnings() -> None:
    """From now on, warnings of this thread wait for `taken_warnings`."""
    collector.set([])


@contextmanager
def collected_warnings() -> Iterator[None]:
    """Inside the block, warnings of this thread wait for `taken_warnings`; after it things are as they were."""
    token = collector.set([])
    try:
        yield
    finally:
        collector.reset(token)


@contextmanager
def python_warnings() -> Iterator[None]:
    """Inside the block, warnings are ordinary Python warnings: they are about no node."""
    token = collector.set(None)
    try:
        yield
    finally:
        collector.reset(token)


def taken_warnings() -> tuple[str, ...]:
    """What was warned of since the last call."""
    collected = collector.get()
    if not collected:
        return ()
    taken = tuple(collected)
    collected.clear()
    return taken
