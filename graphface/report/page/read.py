"""The run inside a report: what `--trace` would have written, for comparing runs."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from graphface.errors import UnreadableFile

RUN = "run"
"""The id of the element that holds the run."""
_ELEMENT = re.compile(rf'<script type="application/json" id="{RUN}">(.*?)</script>', re.DOTALL)


def read_report(path: Path) -> dict[str, Any]:
    """The run of a report, as `Trace.as_json` gives it.

    Raises:
        UnreadableFile: there is no such file, or it is no report.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise UnreadableFile(path, getattr(error, "strerror", None) or "is not UTF-8 text") from None
    found = _ELEMENT.search(text)
    try:
        run = json.loads(found[1]) if found is not None else None
    except ValueError:
        run = None
    if not isinstance(run, dict):
        raise UnreadableFile(path, "is no report of a run")
    return run
