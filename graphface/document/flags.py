"""`--replace` and `--set`: overlays that stand on the command line, or in a call of `graphface.load`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphface.document.document import NAME, NodeEntry, Setting
from graphface.document.located import parse, plain
from graphface.document.overlays import Overlay, Rank
from graphface.document.scalars import scalar
from graphface.errors import DocumentError, Problem
from graphface.place import Place, Source


def read_flag(text: str, flag: str) -> tuple[str, Any]:
    """ "node.parameter=value" of `--set` or `--replace`; the value is a YAML scalar, plain or quoted, or a flow value.

    Raises:
        DocumentError: there is no "=", or the value is not YAML.
    """
    key, equals, value = text.partition("=")
    place = flag_place(flag, text)
    if not equals or not all(NAME.fullmatch(part) for part in key.replace("/", ".").split(".")):
        raise DocumentError([Problem(f"expected name=value, got {text!r}", place)])
    if value[:1] in ("[", "{", "'", '"'):
        try:
            tree, problems = parse(Source(flag, f"value: {value}"))
        except DocumentError as error:
            tree, problems = None, error.problems
        if problems:  # their places are in the value: the flag as a whole is what the user knows
            raise DocumentError([Problem(p.message, place) for p in problems])
        return key, plain(tree["value"])
    return key, scalar(value)


def flag_overlays(replace: Mapping[str, str], settings: Mapping[str, Any], problems: list[Problem]) -> list[Overlay]:
    """Replacements (node path to operator) and parameters ("node.parameter" to value); wrong ones go to `problems`."""
    overlays = []
    for path, operator in replace.items():
        place = flag_place("--replace", f"{path}={operator}")
        entry = NodeEntry(path, place, use=Setting(operator, place))
        overlays.append(Overlay(Rank.REPLACE, tuple(path.split("/")), entry))
    for key, value in settings.items():
        place = flag_place("--set", f"{key}={value}")
        path, dot, parameter = key.rpartition(".")
        if not dot:
            problems.append(Problem(f"{key!r}: expected node.parameter", place))
            continue
        entry = NodeEntry(path, place, settings={parameter: Setting(value, place)})
        overlays.append(Overlay(Rank.SET, tuple(path.split("/")), entry))
    return overlays


def flag_place(flag: str, text: str) -> Place:
    """What a problem with a flag points at: its text."""
    return Place(Source(flag, text), 1, 1)
