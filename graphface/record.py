"""What became of a node in a run: what observers, traces, explanations and errors are told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

State = Literal["ran", "memory", "disk", "failed", "blocked", "declined"]


@dataclass(slots=True)
class Record:
    """What became of one node or input in a run.

    `state`: "ran"; found in "memory" or on "disk"; "failed"; "blocked" by a failure above it; "declined" by the only
    nodes that could have used it, for the `reason` given. `seconds` is wall time, `cpu` that of its thread (measured
    where an observer listens).
    """

    name: str
    operator: str
    state: State
    key: bytes
    seconds: float = 0.0
    cpu: float = 0.0
    bytes: int = 0
    reason: str = ""
    warnings: Sequence[str] = ()
