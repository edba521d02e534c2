"""`graphface show`: the effective document, with the origin of each value."""

from __future__ import annotations

from typing import Annotated

import typer

from graphface.cli.options import GraphName, Plugins, Profiles, Replaces, Sets, Variants, load_graph


def show(
    graph: GraphName,
    sets: Sets = [],  # noqa: B006
    replaces: Replaces = [],  # noqa: B006
    variants: Variants = [],  # noqa: B006
    profiles: Profiles = [],  # noqa: B006
    plugins: Plugins = [],  # noqa: B006
    origins: Annotated[bool, typer.Option(help="Say behind each value which file and line, or flag, set it.")] = True,
) -> None:
    """Print a graph after extends, nesting, variants, profiles and flags: one flat YAML file that runs as it is."""
    loaded = load_graph(graph, sets, replaces, variants, profiles, plugins)
    print(loaded.effective(origins=origins), end="")
