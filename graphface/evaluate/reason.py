"""Why a node runs or does not, as data; the words are made from it and never read back."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Literal

Kind = Literal[
    "",
    "not needed",
    "memoized below",
    "pinned",
    "pinned below",
    "pinned above",
    "unpinned",
    "undecided",
    "declined",
    "unchanged",
    "elsewhere",
    "first seen",
    "operator",
    "code",
    "parameter",
    "wiring",
    "node above",
    "input",
    "lazy ports",
    "failed before",
    "no cache",
    "evicted",
    "not kept",
    "damaged",
    "gone",
    "failed",
    "blocked",
    "twin",
    "not reached",
]

_WORDS: dict[Kind, str] = {
    "": "",
    "not needed": "not needed for {new}",
    "memoized below": "only {node} needs it, and that is memoized",
    "pinned": "{new} stands in for it",
    "pinned below": "only {node} needs it, and that is pinned",
    "pinned above": "{node} is pinned",
    "unpinned": "it is pinned no longer",
    "undecided": "{node} decides when its inputs are there",
    "declined": "{new}",
    "unchanged": "nothing changed",
    "elsewhere": "computed before, by another run or graph",
    "first seen": "first seen",
    "operator": "operator changed from {old} to {new}",
    "code": "operator code changed",
    "parameter": "parameter {parameter} changed from {old} to {new}",
    "wiring": "port {port} is connected to {new}, was {old}",
    "node above": "{node} changed above it",
    "input": "input {node} changed",
    "lazy ports": "which lazy inputs it takes changed",
    "failed before": "it failed when it last ran",
    "no cache": "no cache in use",
    "evicted": "evicted",
    "not kept": "not kept (too large for the cache, or nothing that it can hold)",
    "damaged": "its stored result was damaged",
    "gone": "its stored result was gone when it was needed",
    "failed": "{new}",
    "blocked": "a node above it failed",
    "twin": "equal to {node}, which was evaluated for both",
    "not reached": "what needed it failed, or was memoized meanwhile",
}


@dataclass(frozen=True)
class Reason:
    """One reason; `str` gives its sentence.

    Attributes:
        kind: which rule; the empty one says nothing.
        node: the other node, or input, that it speaks of. port, parameter: of the node itself.
        old, new: what was and what is, as words; of a declined port, what its node said.
    """

    kind: Kind = ""
    node: str = ""
    port: str = ""
    parameter: str = ""
    old: str = ""
    new: str = ""

    def __str__(self) -> str:
        return _WORDS[self.kind].format(**asdict(self))

    def __bool__(self) -> bool:
        return self.kind != ""

    def as_json(self) -> dict[str, str]:
        """The parts that say something."""
        return {name: value for name, value in asdict(self).items() if value}


NO_REASON = Reason()
