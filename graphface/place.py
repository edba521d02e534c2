"""Where a value of a file stands: the text it comes from, line and column.

Positions travel with every value of a graph file through `extends`, variants, profiles and flags, so that any mistake
can be shown where it was made. The lowest module of the engine: errors carry places.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import NamedTuple


@dataclass(frozen=True, eq=False)
class Source:
    """A text that values come from: a graph file, or a command-line flag."""

    name: str
    text: str = field(repr=False)
    path: Path | None = None

    @cached_property
    def lines(self) -> list[str]:
        return self.text.splitlines()

    @property
    def start(self) -> Place:
        return Place(self, 1, 1)


class Place(NamedTuple):
    """A position in a source; line and column count from 1."""

    source: Source
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.source.name}:{self.line}:{self.column}"

    @property
    def excerpt(self) -> str:
        """The source line with a caret under the column."""
        if not 0 < self.line <= len(self.source.lines):
            return ""
        line = "".join(c if c.isprintable() else " " for c in self.source.lines[self.line - 1])
        start = max(0, self.column - 81)
        return f"    {line[start : start + 160]}\n    {' ' * (self.column - 1 - start)}^"
