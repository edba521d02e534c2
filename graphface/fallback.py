"""`warn`: how a node says that it fell back on something, without failing.

Inside a run the sentence lands in the trace beside the node's name; outside, in a notebook or a test, it is an ordinary
Python warning. A context variable carries the collector, since `warnings.catch_warnings` is not thread-safe.
"""

from __future__ import annotations

import warnings
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
