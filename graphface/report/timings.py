"""How long operators took in earlier runs on this machine, for progress bars that tell the time left.

One small JSON file in the user's cache folder: a running mean of seconds by operator. It is a courtesy: unreadable or
unwritable, it is as if there were none.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path

from graphface.record import Record

_UNKNOWN = 0.05
"""Seconds taken for an operator never seen."""
_WEIGHT = 0.3
"""Of the newest run in the running mean."""


class Timings:
    """Expected seconds by operator."""

    def __init__(self, seconds: dict[str, float] | None = None) -> None:
        self._seconds = dict(seconds or {})

    @classmethod
    def load(cls) -> Timings:
        try:
            stored = json.loads(_file().read_text(encoding="utf-8"))
            seconds = {str(name): float(value) for name, value in stored.items()}
            return cls({name: value for name, value in seconds.items() if 0 <= value < math.inf})
        except (OSError, ValueError, TypeError, AttributeError):
            return cls()

    def expected(self, operator: str) -> float:
        return self._seconds.get(operator, _UNKNOWN)

    def learn(self, records: Sequence[Record]) -> None:
        """Take in what a run measured and store it."""
        ran = [r for r in records if r.state == "ran"]
        for record in ran:
            before = self._seconds.get(record.operator, record.seconds)
            self._seconds[record.operator] = round(before + _WEIGHT * (record.seconds - before), 6)
        if ran:
            self._store()

    def _store(self) -> None:
        from graphface.errors import UnwritableFile
        from graphface.values.writing import beside

        try:
            _file().parent.mkdir(parents=True, exist_ok=True)
            with beside(_file()) as path:
                path.write_text(json.dumps(self._seconds), encoding="utf-8")
        except (OSError, UnwritableFile):
            return


def _file() -> Path:
    from platformdirs import user_cache_path

    return user_cache_path("graphface") / "timings.json"
