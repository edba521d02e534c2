"""`graphface nodes`: the operators there are, and the reference of one."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphface.cli.options import Plugins


def nodes(
    name: Annotated[str, typer.Argument(help="An operator; without one, all are listed.")] = "",
    plugins: Plugins = [],  # noqa: B006
) -> None:
    """List the operators, or show one: its ports, parameters, documentation and what may take its place."""
    from graphface.fallback import warn
    from graphface.registry import default_registry
    from graphface.report.terminal import print_operator, print_operators

    registry = default_registry().extended()
    for plugin in plugins:
        registry.add_file(Path(plugin))
    if name:
        operator = registry.operator(name)
        if operator.name != name:
            warn(f"operator {name!r} is now called {operator.name!r}")
        print_operator(operator, [other.name for other in registry.alternatives(operator)])
    else:
        print_operators(registry.operators())
