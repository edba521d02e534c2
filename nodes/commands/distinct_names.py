"""Results that are named after their sources."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path


def check_distinct(files: Iterable[Path]) -> None:
    """Of two files of one name the second's results would overwrite the first's.

    Raises:
        UsageError: two files have the same name before the suffix.
    """
    from graphface import UsageError

    known: dict[str, Path] = {}
    for file in files:
        if file.stem in known:
            raise UsageError(
                f"{known[file.stem]} and {file}: the pictures made from one would overwrite those from the other; "
                "rename one of the two"
            )
        known[file.stem] = file
