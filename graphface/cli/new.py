"""`graphface new`: a commented graph to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

_STARTER = """\
# yaml-language-server: $schema=graphface.schema.json
# (graphface schema -o graphface.schema.json makes your editor complete and check this file)
graphface: 1
name: {name}
doc: What this graph does, in a sentence.

# extends: relight.yaml       start from another graph; what stands below is laid over it

inputs:
  photo: Image                # -i photo=portrait.jpg

nodes:
  linear:
    use: image.encode         # an operator (graphface nodes), or another graph file
    in: {{photo: photo}}        # port: the name of an input or node, or node.field
    with: {{encoding: linear}}  # parameters; --set linear.encoding=srgb wins over this

outputs:
  image: linear               # -o out.png writes the first output, -o name=file any other

# variants:                   --variant NAME changes operators, wires or parameters
#   plain: {{linear: {{with: {{encoding: srgb}}}}}}
# profiles:                   --profile NAME sets parameters: how accurate, how fast
#   draft: {{linear: {{encoding: srgb}}}}
"""


def new(path: Annotated[Path, typer.Argument(help="The graph file to write; it must not exist.")]) -> None:
    """Start a commented graph file."""
    from graphface.errors import UsageError
    from graphface.values.writing import beside, check_folder

    if path.suffix not in (".yaml", ".yml"):
        raise UsageError(f"{path}: a graph file ends in .yaml")
    if path.exists():
        raise UsageError(f"{path}: exists already; it was left as it is")
    check_folder(path)
    with beside(path) as temporary:
        temporary.write_text(_STARTER.format(name=path.stem), encoding="utf-8")
    print(f"wrote {path}; run it with: graphface run {path} -i photo=portrait.jpg -o out.png")
