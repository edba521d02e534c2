"""`graphface schema`: JSON Schemas for editors, of graph files and of other files that packs describe."""

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
    kind: Annotated[
        str, typer.Option(metavar="KIND", help="Of which files: graph, or a kind that a pack describes (scene).")
    ] = "graph",
    plugins: Plugins = [],  # noqa: B006
) -> None:
    """Write a JSON Schema of graph files (operators, ports, parameters, ranges, documentation) or of another kind."""
    from graphface.document.schema import schema_of
    from graphface.registry import default_registry
    from graphface.values.writing import beside, check_folder

    registry = default_registry().extended()
    for plugin in plugins:
        registry.add_file(plugin)
    text = json.dumps(schema_of(kind, registry), indent=1)
    if output is None:
        print(text)
        return
    check_folder(output)
    with beside(output) as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")
