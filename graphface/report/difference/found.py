"""What a comparison found: every node whose value is not the same on both sides, in an order that runs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape

from graphface.evaluate.reason import Reason
from graphface.report.difference.node import NodeDifference
from graphface.report.difference.tolerance import EXACT, Tolerance
from graphface.report.difference.words import HEADER, in_full, row, short


@dataclass(frozen=True)
class Differences:
    """The answer of a comparison; what is listed differs by more than `tolerance`.

    Attributes:
        labels: what side A and side B are called.
        nodes: in an order that runs. below: those that differ, but by no more than the tolerance.
        without_effect: nodes that were changed themselves and have equal values all the same, with their reasons.
        failed_alike: nodes that fail on both sides in the same way, with the message.
        not_compared: nodes that cannot be, with the reason.
        compared: how many nodes both sides have; equal: how many of them had the same key, and were not looked at.
    """

    labels: tuple[str, str]
    nodes: Sequence[NodeDifference]
    below: Sequence[NodeDifference] = ()
    without_effect: Sequence[tuple[str, tuple[Reason, ...]]] = ()
    failed_alike: Sequence[tuple[str, str]] = ()
    not_compared: Sequence[tuple[str, str]] = ()
    compared: int = 0
    equal: int = 0
    tolerance: Tolerance = EXACT

    def __bool__(self) -> bool:
        """Whether anything differs."""
        return bool(self.nodes)

    def __iter__(self) -> Iterator[NodeDifference]:
        return iter(self.nodes)

    def __len__(self) -> int:
        return len(self.nodes)

    @property
    def first(self) -> NodeDifference | None:
        """The first node in order that both sides have and that differs; where there is none, the first listed."""
        return next((node for node in self.nodes if node.kind in ("values", "failed")), next(iter(self.nodes), None))

    @property
    def rows(self) -> list[Sequence[str]]:
        """A line for every node under `words.HEADER`: its part that differs most."""
        return [row(node) for node in self.nodes]

    @property
    def summary(self) -> str:
        """How many nodes differ, and how many were not even looked at."""
        both = sum(node.kind in ("values", "failed") for node in self.nodes)
        phrases = [f"{both} of {self.compared} nodes differ" if both else f"no node of {self.compared} differs"]
        if alone := len(self.nodes) - both:
            phrases.append(f"{alone} on one side only")
        if self.below:
            largest = max(node.relative for node in self.below)
            phrases.append(
                f"{len(self.below)} differ within the tolerance of {self.tolerance} (up to {short(largest)})"
            )
        if self.equal:
            phrases.append(f"{self.equal} have the same key: nothing to compare")
        return "; ".join(phrases)

    @property
    def notes(self) -> list[str]:
        """What is worth knowing beside the differences, a sentence each."""
        idle = [f"{name}: {'; '.join(map(str, why))}, with no effect on its value" for name, why in self.without_effect]
        alike = [f"{name}: fails on both sides: {why}" for name, why in self.failed_alike]
        return [*idle, *alike, *(f"{name}: not compared: {why}" for name, why in self.not_compared)]

    @property
    def lines(self) -> list[str]:
        """The first node that differs, in full."""
        if self.first is None:
            return []
        first, *others = in_full(self.first)
        return [f"first difference: {first}", *others]

    def _repr_html_(self) -> str:
        """The table, for a notebook."""
        heads = "".join(f"<th>{escape(title.lstrip('>'))}</th>" for title in HEADER)
        lines = ("".join(f"<td>{escape(cell)}</td>" for cell in cells) for cells in self.rows)
        body = "".join(f"<tr>{line}</tr>" for line in lines)
        table = f"<table><tr>{heads}</tr>{body}</table>" if self.nodes else ""
        return f"<p>{escape(self.summary)}</p>{table}{''.join(f'<p>{escape(note)}</p>' for note in self.notes)}"
