"""`graphface replay`: run a node that failed again, alone, from what `run --save-failure` kept."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphface.cli.options import Plugins

if TYPE_CHECKING:
    from graphface.report.replay import Failure


def replay(
    file: Annotated[Path, typer.Argument(metavar="FILE.zip", help="What --save-failure wrote.")],
    sets: Annotated[list[str], typer.Option("--set", metavar="PARAM=VALUE", help="Set a parameter of the node.")] = [],  # noqa: B006
    output: Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE", help="Write its value.")] = None,
    pdb: Annotated[bool, typer.Option("--pdb", help="Step through it in pdb.")] = False,
    plugins: Plugins = [],  # noqa: B006
) -> None:
    """Run a node that failed again, alone: does it fail the same way, otherwise, or work now?

    Exit code 0 where it works, 1 where it fails.
    """
    from graphface.document.flags import read_flag
    from graphface.registry import default_registry
    from graphface.report.replay import load_failure
    from graphface.values.frozen import describe
    from graphface.values.writing import check_output, write_output

    registry = default_registry().extended()
    for plugin in plugins:
        registry.add_file(plugin)
    failure = load_failure(file, registry)
    operator = failure.operator()
    if output is not None:
        check_output(output, operator.output, registry.files)
    changes = dict(read_flag(text, "--set") for text in sets)
    given = {**failure.arguments, **failure.parameters(changes)}
    _tell(failure)
    if pdb:
        from graphface.debug.stepping import step_through

        step_through(operator.function, given)
    now = failure.run(changes)
    if now.error is None:
        print(f"now: it works and gives {describe(now.value)}")
        if output is not None:
            write_output(now.value, operator.output, output, registry.files)
        return
    print(
        "now: it fails the same way" if now.reason == failure.about.error else f"now: it fails otherwise: {now.reason}"
    )
    if now.line is not None:
        print(f"    {now.line}")
    raise typer.Exit(1)


def _tell(failure: Failure) -> None:
    """What failed then, with what, and whether the code is the same here."""
    from graphface.values.frozen import describe

    about = failure.about
    print(f"node {about.node!r} ({about.operator}) of graph {about.graph!r}, {about.place}")
    for port, value in failure.arguments.items():
        print(f"    {port}: {describe(value)}")
    print(f"then: {about.error}")
    if about.others:
        print(f"      {', '.join(about.others)} failed in the same run")
    changes = failure.code_changes()
    if changes is None:
        print("code: the same as then")
    else:
        others = f" ({'; '.join(changes)})" if changes else ""
        print(f"code: not the same as then{others}")
