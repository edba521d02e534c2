"""What a run knows of one key: what waits for its value, what it waits for, and who still reads it."""

from __future__ import annotations

from graphface.graph.keys import Declined
from graphface.graph.structure import Step


class Task:
    """One key that is demanded in a run.

    `waiting` counts the values it waits for, `waiters` wait for its own. `sources` are the tasks whose values it reads,
    `readers` counts those that read its own. `declined` are the lazy ports that its step does without; None while its
    rule cannot be asked. `heavy` where letting go of its value frees memory.
    """

    __slots__ = (
        "declined",
        "failed",
        "heavy",
        "key",
        "readers",
        "size",
        "slot",
        "sources",
        "step",
        "waiters",
        "waiting",
    )

    def __init__(self, key: bytes, slot: int, step: Step | None) -> None:
        self.key: bytes = key
        self.slot: int = slot
        self.step: Step | None = step
        self.waiting: int = 0
        self.waiters: list[Task] = []
        self.sources: list[Task] = []
        self.readers: int = 0
        self.declined: Declined | None = None
        self.failed: bool = False
        self.heavy: bool = False
        self.size: int = 0


def label(task: Task, first: int) -> str:
    """What a record calls the operator; an input has none, nor has a pinned node.

    Args:
        first: the slot of the graph's first node.
    """
    if task.step is not None:
        return task.step.operator.name
    return "input" if task.slot < first else "pinned"
