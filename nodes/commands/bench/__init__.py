"""`graphface bench`: accuracy against ground truth, each figure beside what it cost in CPU time. One file a command.

A command's file is imported when it is asked for: no other part of the command line pays for the benches.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

import typer
from typer.core import TyperGroup

COMMANDS = (
    *("lights", "scenes", "geometry", "poses", "intrinsic", "light"),
    *("masks", "matting", "makeup", "transfer", "looks", "details"),
)
"""Each a module here, with a function of the same name."""


class _Benches(TyperGroup):
    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.commands: Any = dict.fromkeys(COMMANDS)  # names only: what lists and corrects them needs no more

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        if cmd_name not in self.commands:
            return None
        single = typer.Typer(add_completion=False)
        single.command(cmd_name)(getattr(import_module(f"{__name__}.{cmd_name}"), cmd_name))
        return typer.main.get_command(single)


app: typer.Typer = typer.Typer(
    cls=_Benches, help="Measure accuracy on ground truth, and its CPU time.", no_args_is_help=True
)


@app.callback()
def bench() -> None:
    """Measure accuracy on ground truth, and its CPU time."""
