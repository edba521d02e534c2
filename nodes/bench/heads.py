"""The path-traced heads of a folder of ground truth."""

from __future__ import annotations

from pathlib import Path

from graphface import UnreadableFile

LIGHTS = ("frontal", "left45", "right45", "top", "left80_hard", "ambient", "red_blue")
"""Under which each head was traced: LIGHT.png in its folder."""


def heads_of(data: Path, holding: str = "meta.json") -> list[Path]:
    """The folders under `data`/truth that hold a file of that name, in order.

    Raises:
        UnreadableFile: there are none.
    """
    found = sorted(path.parent for path in (data / "truth").glob(f"*/{holding}"))
    if not found:
        raise UnreadableFile(data / "truth", f"holds no heads (folders with a {holding})")
    return found
