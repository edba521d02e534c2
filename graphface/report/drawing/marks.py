"""What a drawing says about a node beside what it is: what became, or would become, of it in a run, and why."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

MarkState = Literal["ran", "memory", "disk", "pinned", "declined", "skipped", "failed", "blocked", ""]
DIMMED = frozenset({"declined", "skipped", "blocked"})


@dataclass(frozen=True)
class Mark:
    """Of one node.

    Attributes:
        state: dims what did not run and frames what failed.
        reason: a sentence, in the tooltip and as far as it fits in the box.
        heat: a share in 0..1 that a bar shows: of the run's time or memory, say.
        label: a word or two instead of the state's name: "12 ms".
    """

    state: MarkState = ""
    reason: str = ""
    heat: float | None = None
    label: str = ""

    @property
    def dimmed(self) -> bool:
        return self.state in DIMMED

    @property
    def words(self) -> str:
        """The line that the box shows."""
        label = self.label or self.state
        return f"{label}: {self.reason}" if label and self.reason else label or self.reason
