"""Which file each output goes to: what `-o [NAME=]FILE` says."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from graphface.errors import UsageError
from graphface.graph.wired import WiredGraph


def output_files(graph: WiredGraph, asked: Sequence[str], given: Mapping[str, str]) -> dict[str, Path]:
    """Output name to file; a bare FILE is the graph's first output.

    {photo} in a file name stands for the name of the file given for input `photo`, without folder and suffix.

    Raises:
        UsageError: no output was asked for, one twice, or a file name says {something} that is no input given.
    """
    if not asked:
        raise UsageError(f"no output asked for; add -o FILE, or -o NAME=FILE (outputs: {', '.join(graph.outputs)})")
    files: dict[str, Path] = {}
    for text in asked:
        name, equals, file = text.partition("=")
        if not equals:
            if not graph.outputs:
                raise UsageError(f"-o {text}: the graph declares no output; say -o NODE={text}")
            name, file = next(iter(graph.outputs)), text
        if not name or not file:
            raise UsageError(f"-o {text!r}: expected FILE or NAME=FILE")
        if name in files:
            raise UsageError(f"-o {text}: output {name!r} is asked for twice")
        files[name] = Path(_filled(file, given))
    return files


def _filled(template: str, given: Mapping[str, str]) -> str:
    """A file name with its {input} places filled; what is put in never holds a separator, so it stays in its folder."""

    def stem(match: re.Match[str]) -> str:
        name = match.group(1)
        if name not in given:
            raise UsageError(f"-o {template}: no input {name!r} was given (given: {', '.join(given) or 'none'})")
        return re.sub(r"[^\w.-]", "_", Path(given[name]).stem).lstrip(".") or "_"

    return re.sub(r"\{([^{}]*)\}", stem, template)


def check_apart(results: Iterable[tuple[str, Path]]) -> None:
    """Refuse before anything runs to write two results into one file: the first would be lost.

    Args:
        results: what is written, in words, and its file.
    """
    seen: dict[str, str] = {}
    for what, path in results:
        place = os.path.realpath(path)
        if place in seen:
            raise UsageError(f"{path}: {seen[place]} and {what} would be written to this one file; name two")
        seen[place] = what


def check_kept(results: Iterable[Path], given: Iterable[str]) -> None:
    """Refuse before anything runs to write a result over a file that was given."""
    kept = {os.path.realpath(file) for file in given}
    for path in results:
        if os.path.realpath(path) in kept:
            raise UsageError(f"{path}: this file is an input, and would be lost; give the result another name")
