"""`graphface schema`: a JSON Schema of graph files for editors."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from graphface.cli.options import Plugins


def schema(
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="File to write; standard output by default.")
    ] = None,
    plugins: Plugins = [],  # noqa: B006
) -> None:
    """Write a JSON Schema of graph files: operators, ports, parameters, ranges and documentation."""
    from graphface.document.schema import graph_schema
    from graphface.registry import default_registry
    from graphface.values.writing import beside, check_folder

    registry = default_registry().extended()
    for plugin in plugins:
        registry.add_file(plugin)
    text = json.dumps(graph_schema(registry), indent=1)
    if output is None:
        print(text)
        return
    check_folder(output)
    with beside(output) as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")
