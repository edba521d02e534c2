"""What `graphface diff` compares, from words on the command line: graphs with flags, or what earlier runs left."""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from graphface.errors import UsageError

if TYPE_CHECKING:
    from graphface.facade import Graph
    from graphface.registry import Registry
    from graphface.report.difference.recorded import Recorded


@dataclass
class Flags:
    """The options of `run` that choose what is run; those that stand for both sides, or one side's own."""

    inputs: list[str] = field(default_factory=list)
    sets: list[str] = field(default_factory=list)
    replaces: list[str] = field(default_factory=list)
    variants: list[str] = field(default_factory=list)
    profiles: list[str] = field(default_factory=list)
    plugins: list[Path] = field(default_factory=list)


@dataclass
class Given:
    """One side, loaded; its inputs are not bound yet.

    Attributes:
        text: as the user wrote it. inputs: its own "-i". recorded: the earlier run it comes from, if it does.
    """

    text: str
    graph: Graph
    inputs: dict[str, Any]
    recorded: Recorded | None


def read_sides(texts: Sequence[str], common: Flags) -> list[Given]:
    """Load sides: "GRAPH --set NODE.PARAM=VALUE -i NAME=FILE", a trace, a report, or a result with its graph inside.

    A plug-in is loaded once for all of them: loaded again it would be other code, and every node of it would differ.

    Args:
        common: what is added to every side's own flags.

    Raises:
        UsageError: a flag that is none, a file that is none of these.
    """
    from graphface.registry import default_registry

    shared = _extended(default_registry(), common.plugins)
    known: dict[tuple[Path, ...], Registry] = {(): shared}
    sides = []
    for text in texts:
        source, own = _split(text)
        plugins = tuple(own.plugins)
        if plugins not in known:
            known[plugins] = _extended(shared, plugins)
        sides.append(_loaded(text, source, own, common, known[plugins]))
    return sides


def bound_inputs(sides: list[Given], common: list[str]) -> list[dict[str, Any]]:
    """The inputs of every side: its own, those given for both, those of the run it comes from.

    A graph takes what it needs and has not been given from the other side. From an earlier run it takes all, with the
    defaults of that run, so that both are asked the same question.

    Raises:
        UsageError: an input of an earlier run cannot be had again, or one is given that no side has.
    """
    from graphface.cli.options import read_inputs
    from graphface.errors import InputError, nearest_names
    from graphface.graph.inputs import missing_inputs
    from graphface.report.difference.recorded import bound_again

    shared = read_inputs(common)
    known = {name for side in sides for name in side.graph.inputs}
    for name in shared:
        if name not in known:
            raise InputError(name, "no side has such an input", nearest_names(name, known))
    bound: list[dict[str, Any]] = []
    for side in sides:
        given = {name: value for name, value in shared.items() if name in side.graph.inputs} | side.inputs
        bound.append(bound_again(side.graph, side.recorded, given) if side.recorded is not None else given)
    for side, inputs, other, others in zip(sides, bound, reversed(sides), reversed(bound), strict=True):
        if side.recorded is None:
            missing = side.graph.inputs if other.recorded is not None else missing_inputs(side.graph.inputs, inputs)
            inputs |= {name: others[name] for name in missing if name in others and name not in inputs}
    return bound


def _extended(registry: Registry, plugins: Sequence[Path]) -> Registry:
    extended = registry.extended() if plugins else registry
    for plugin in plugins:
        extended.add_file(plugin)
    return extended


def _loaded(text: str, source: str, own: Flags, common: Flags, registry: Registry) -> Given:
    from graphface.cli.options import load_graph, read_inputs
    from graphface.report.difference.recorded import SUFFIXES, read_recorded

    recorded = read_recorded(Path(source)) if source.lower().endswith(SUFFIXES) else None
    graph = load_graph(
        recorded.document if recorded is not None else source,
        [*common.sets, *own.sets],
        [*common.replaces, *own.replaces],
        [*common.variants, *own.variants],
        [*common.profiles, *own.profiles],
        [],
        registry,
    )
    return Given(text, graph, read_inputs(own.inputs), recorded)


def _split(text: str) -> tuple[str, Flags]:
    if Path(text).is_file():  # its name may hold spaces
        return text, Flags()
    try:
        words = shlex.split(text)
    except ValueError as error:
        raise UsageError(f"{text!r}: {error}") from None
    parser = _Parser(prog=text, add_help=False, allow_abbrev=False)
    parser.add_argument("graph")
    for names, where in (
        (("-i", "--input"), "inputs"),
        (("--set",), "sets"),
        (("--replace",), "replaces"),
        (("--variant",), "variants"),
        (("--profile",), "profiles"),
    ):
        parser.add_argument(*names, dest=where, action="append", default=[])
    parser.add_argument("--plugin", dest="plugins", action="append", default=[], type=Path)
    found = vars(parser.parse_args(words))
    return found.pop("graph"), Flags(**found)


class _Parser(argparse.ArgumentParser):
    """Mistakes are the user's, in one sentence."""

    def error(self, message: str) -> NoReturn:
        flags = "-i, --set, --replace, --variant, --profile, --plugin"
        raise UsageError(f"{self.prog!r}: {message}; expected GRAPH with any of {flags}")
