"""`graphface bench`: accuracy against ground truth, each figure beside what it cost in CPU time. One file a command."""

from __future__ import annotations

import typer

from graphface.nodes.commands.bench import (
    geometry,
    intrinsic,
    light,
    lights,
    makeup,
    masks,
    matting,
    poses,
    scenes,
    transfer,
)

app = typer.Typer(help="Measure accuracy on ground truth, and the CPU time it takes.", no_args_is_help=True)


@app.callback()
def bench() -> None:
    """Measure accuracy on ground truth, and the CPU time it takes."""


app.command()(lights.lights)
app.command()(scenes.scenes)
app.command()(geometry.geometry)
app.command()(poses.poses)
app.command()(intrinsic.intrinsic)
app.command()(light.light)
app.command()(masks.masks)
app.command()(matting.matting)
app.command()(makeup.makeup)
app.command()(transfer.transfer)
