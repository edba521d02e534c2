"""Options that several commands share: which graph, with which choices, on which inputs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, overload

import typer

if TYPE_CHECKING:
    from graphface.cache.disk import DiskTier
    from graphface.evaluate.evaluator import Evaluator
    from graphface.facade import Graph
    from graphface.registry import Registry

GraphName = Annotated[
    str, typer.Argument(metavar="GRAPH", help="A graph file, or the name of a shipped one (relight).")
]
Inputs = Annotated[
    list[str], typer.Option("-i", "--input", metavar="NAME=VALUE", help="A graph input: a file, or a value.")
]
Pins = Annotated[
    list[str], typer.Option("--pin", metavar="NODE=FILE", help="Use this file, or value, in place of a node's result.")
]
Asked = Annotated[
    list[str], typer.Option("-o", "--output", metavar="NAME", help="An output, or any node.port; default: all.")
]
Sets = Annotated[
    list[str], typer.Option("--set", metavar="NODE.PARAM=VALUE", help="Set a parameter; wins over everything.")
]
Replaces = Annotated[
    list[str], typer.Option("--replace", metavar="NODE=OPERATOR", help="Use another operator for a node.")
]
Variants = Annotated[list[str], typer.Option("--variant", metavar="NAME", help="A variant that the graph declares.")]
Profiles = Annotated[list[str], typer.Option("--profile", metavar="NAME", help="A profile that the graph declares.")]
Plugins = Annotated[list[Path], typer.Option("--plugin", metavar="FILE.py", help="A file of further operators.")]

Cache = Annotated[
    Path | None,
    typer.Option("--cache", metavar="DIR", envvar="GRAPHFACE_CACHE", help="Keep results in this folder between runs."),
]
CacheSize = Annotated[
    str | None,
    typer.Option("--cache-size", metavar="SIZE", help="What the folder may hold: 20G (GRAPHFACE_CACHE_SIZE; 10G)."),
]
Memory = Annotated[
    str | None,
    typer.Option("--memory", metavar="SIZE", help="What may be kept in memory: 4G, 500M (GRAPHFACE_MEMORY; 2GiB)."),
]
Threads = Annotated[int, typer.Option("--threads", min=0, help="Nodes that may run at once; 0: one per core.")]
GuardName = Annotated[str, typer.Option("--guard", help="What to do about NaN and infinity: off, warn or error.")]


def load_graph(
    graph: str,
    sets: list[str],
    replaces: list[str],
    variants: list[str],
    profiles: list[str],
    plugins: list[Path],
    registry: Registry | None = None,
) -> Graph:
    """The graph with everything that the flags say.

    Args:
        registry: where names are looked up, under those of the plug-ins; everything installed by default.

    Raises:
        DocumentError, UnreadableFile, PluginError: see `graphface.load`.
    """
    from graphface.facade import load

    return load(graph, **read_choices(sets, replaces, variants, profiles), plugins=plugins, registry=registry)


def read_choices(sets: list[str], replaces: list[str], variants: list[str], profiles: list[str]) -> dict[str, Any]:
    """Flags that change a graph, as `graphface.load` takes them.

    Raises:
        UsageError: one is not of the form that it must have.
    """
    from graphface.document.flags import read_flag

    return {
        "set": dict(read_flag(text, "--set") for text in sets),
        "replace": dict(_pair(text, "--replace") for text in replaces),
        "variants": variants,
        "profiles": profiles,
    }


def open_evaluator(
    reports: list[str],
    cache: Path | None,
    cache_size: str | None,
    memory: str | None,
    *,
    threads: int = 0,
    guard: str = "error",
    keeps: bool = True,
) -> Evaluator:
    """An evaluator as the flags say.

    Args:
        reports: gets what its disk tier has to report.
        threads: 0 for one per core. keeps: whether it has a memory tier.

    Raises:
        UsageError: a size that is none, or another guard.
    """
    import os

    from graphface.cache.memory import MemoryTier
    from graphface.errors import UsageError
    from graphface.evaluate.evaluator import Evaluator
    from graphface.settings import memory_budget

    if guard not in ("off", "warn", "error"):
        raise UsageError(f"--guard {guard!r}: expected off, warn or error")
    return Evaluator(
        memory=MemoryTier(memory_budget(memory)) if keeps else None,
        disk=open_cache(cache, reports, cache_size),
        threads=threads or os.cpu_count() or 1,
        guard=guard,  # type: ignore[arg-type]
    )


@overload
def open_cache(folder: None, said: list[str], size: str | None = None) -> None: ...
@overload
def open_cache(folder: Path, said: list[str], size: str | None = None) -> DiskTier: ...
@overload
def open_cache(folder: Path | None, said: list[str], size: str | None = None) -> DiskTier | None: ...
def open_cache(folder: Path | None, said: list[str], size: str | None = None) -> DiskTier | None:
    """The disk tier of a folder; what it reports is appended to `said`.

    Args:
        size: of `--cache-size`; see `graphface.settings`.

    Raises:
        UsageError: the size that is set is none.
    """
    if folder is None:
        return None
    from graphface.cache.disk import DiskTier
    from graphface.settings import cache_size

    return DiskTier(folder, cache_size(size), said.append)


def read_inputs(pairs: list[str]) -> dict[str, Any]:
    """ "name=value" flags as a dictionary.

    Raises:
        UsageError: a flag is not of that form, or an input is given twice.
    """
    return _read_pairs(pairs, "-i", "input {name!r} is given twice; --map {name}=FOLDER runs every file of one")


def read_pins(pairs: list[str]) -> dict[str, Any]:
    """ "node=value" flags as a dictionary.

    Raises:
        UsageError: a flag is not of that form, or a node is pinned twice.
    """
    return _read_pairs(pairs, "--pin", "node {name!r} is pinned twice")


def _read_pairs(pairs: list[str], flag: str, twice: str) -> dict[str, Any]:
    from graphface.errors import UsageError

    given: dict[str, Any] = {}
    for text in pairs:
        name, value = _pair(text, flag)
        if name in given:
            raise UsageError(f"{flag} {text!r}: {twice.format(name=name)}")
        given[name] = value
    return given


def _pair(text: str, flag: str) -> tuple[str, str]:
    from graphface.errors import UsageError

    name, equals, value = text.partition("=")
    if not equals or not name or not value:
        raise UsageError(f"{flag} {text!r}: expected NAME=VALUE")
    return name, value
