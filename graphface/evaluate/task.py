"""What a run knows of one key: what waits for its value, what it waits for, and who still reads it."""

from __future__ import annotations

from collections.abc import Sequence

from graphface.graph.keys import Declined
from graphface.graph.structure import Step


class Task:
    """One key that is demanded in a run.

    `waiting` counts the values it waits for, `waiters` wait for its own. `sources` are the tasks whose values it reads,
    `readers` counts those that read its own. `declined` are the lazy ports that its step does without; None while its
    rule cannot be asked. `heavy` where letting go of its value frees memory.
    """

    waiting = 0
    sources: Sequence[Task] = ()
    readers = 0
    declined: Declined | None = None
    failed = False
    heavy = False
    size = 0

    def __init__(self, key: bytes, slot: int, step: Step | None) -> None:
        self.key = key
        self.slot = slot
        self.step = step
        self.waiters: list[Task] = []


def label(step: Step | None) -> str:
    """What a record calls the operator; an input has none."""
    return step.operator.name if step is not None else "input"
