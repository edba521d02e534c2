"""What can go wrong, whose mistake it is, and where it is.

Every error carries its parts (path, line, node, expected ...) as attributes and builds its sentence from them, so that
a test or an editor need not read the sentence. Two families matter to the command line: `UsageError` means that what
was asked cannot be done (exit code 2), `RunError` that doing it failed (exit code 1).
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from pathlib import Path


class GraphfaceError(Exception):
    """Base of all errors that speak to the user."""


class UsageError(GraphfaceError):
    """The request is wrong: a file, a name, an option. Nothing was run."""


class RunError(GraphfaceError):
    """The request was understood and failed on the way."""


class PluginError(UsageError):
    """A plug-in file could not be used."""

    def __init__(self, message: str, path: Path) -> None:
        super().__init__(message)
        self.path = path


class UnknownName(UsageError, LookupError):
    """A name that means nothing; `nearest` are the likely ones meant."""

    kind = "name"

    def __init__(self, name: str, known: Iterable[str]) -> None:
        self.name = name
        self.known = sorted(known)
        self.nearest = nearest_names(name, self.known)
        super().__init__(f"unknown {self.kind} {name!r}{did_you_mean(self.nearest)}")

    def __str__(self) -> str:
        return str(self.args[0])


class UnknownOperator(UnknownName):
    kind = "operator"


class UnknownType(UnknownName):
    kind = "type"


class UnreadableFile(UsageError):
    """A file given as input cannot be read as what it should be."""

    def __init__(self, path: Path | str, reason: str) -> None:
        super().__init__(f"{path}: {reason}")
        self.path = Path(path)
        self.reason = reason


class UnwritableFile(RunError):
    """A result could not be written."""

    def __init__(self, path: Path | str, reason: str) -> None:
        super().__init__(f"{path}: {reason}")
        self.path = Path(path)
        self.reason = reason


def nearest_names(name: str, known: Iterable[str], count: int = 3) -> list[str]:
    """The known names most like `name`, best first; the same word with another prefix counts as near."""
    candidates = list(known)
    close = difflib.get_close_matches(name, candidates, count, cutoff=0.6)
    tail = name.rpartition(".")[2]
    same_tail = [c for c in candidates if c.rpartition(".")[2] == tail and c not in close]
    return (close + same_tail)[:count]


def did_you_mean(names: list[str]) -> str:
    return f"; did you mean {' or '.join(repr(n) for n in names)}?" if names else ""
