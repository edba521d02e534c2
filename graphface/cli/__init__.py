"""The command line: one short file per command, joined by those of installed packs.

Every error that speaks to the user leaves here as one message on standard error and an exit code: 2 where the request
was wrong, 1 where doing it failed, 130 where it was interrupted. A traceback is shown only with GRAPHFACE_TRACEBACK=1.
"""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import EntryPoint, entry_points
from typing import Any

import typer
from typer.core import TyperGroup

from graphface.cli import ablate, assets, cache, diff, draw, explain, new, nodes, plan, replay, run, schema, show
from graphface.cli.messages import message
from graphface.packs import load_entry_point

ENTRY_POINTS = "graphface.commands"
_INTERRUPTED = 130


def build() -> TyperGroup:
    """The command with the subcommands of the engine and of every installed pack."""
    app = typer.Typer(
        name="graphface",
        help="Edit photographs of faces with graphs of swappable operators.",
        no_args_is_help=True,
        add_completion=False,
        rich_markup_mode="rich",
    )
    app.callback()(_version)
    app.command("run")(run.run)
    app.command("plan")(plan.plan)
    app.command("explain")(explain.explain)
    app.command("diff")(diff.diff)
    app.command("ablate")(ablate.ablate)
    app.command("show")(show.show)
    app.command("draw")(draw.draw)
    app.command("replay")(replay.replay)
    app.command("nodes")(nodes.nodes)
    app.command("new")(new.new)
    app.command("schema")(schema.schema)
    app.add_typer(assets.app, name="assets")
    app.add_typer(cache.app, name="cache")
    group = typer.main.get_group(app)
    for point in sorted(entry_points(group=ENTRY_POINTS), key=lambda p: p.name):
        _add_command_of_pack(group, point)
    return group


def _add_command_of_pack(group: TyperGroup, point: EntryPoint) -> None:
    """Add the command that an entry point names: a `typer.Typer`, or a function.

    One that cannot be used is left out, with a warning: somebody else's mistake must not keep the others from working.
    """

    def read(named: Any) -> Any:
        if point.name in group.commands:
            raise ValueError("there is a command of this name already")
        if isinstance(named, typer.Typer):
            return typer.main.get_group(named)
        if not callable(named):
            raise TypeError(f"it is a {type(named).__name__}, no command")
        app = typer.Typer(add_completion=False, rich_markup_mode="rich")
        app.command(point.name)(named)
        return typer.main.get_command(app)

    command = load_entry_point(point, read)
    if command is not None:
        command.name = point.name
        group.add_command(command)


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and exit."""
    if os.environ.get("GRAPHFACE_TRACEBACK"):
        build()(arguments)
        return
    sys.exit(_guarded(arguments))


def _guarded(arguments: list[str] | None) -> int:
    from graphface.errors import GraphfaceError, UsageError, out_of_memory

    try:
        with _spoken_warnings():
            result = build()(arguments, standalone_mode=False)
        if result == _INTERRUPTED:  # some versions of typer turn the interrupt into this exit code
            raise KeyboardInterrupt
    except GraphfaceError as error:
        _say(message(error))
        return 2 if isinstance(error, UsageError) else 1
    except (KeyboardInterrupt, typer.Abort):
        _say("interrupted; what was computed is kept where a cache is in use")
        return _INTERRUPTED
    except MemoryError as error:
        _say(out_of_memory(error))
        return 1
    except BrokenPipeError:
        sys.stderr.close()
        return 1
    except Exception as error:
        if hasattr(error, "exit_code") and hasattr(error, "format_message"):
            error.show()  # type: ignore[attr-defined]
            return int(error.exit_code)
        _say(f"internal error: {type(error).__name__}: {error} (GRAPHFACE_TRACEBACK=1 shows where)")
        return 1
    return result if isinstance(result, int) else 0


@contextmanager
def _spoken_warnings() -> Iterator[None]:
    """Every `GraphfaceWarning` outside a node as one line on standard error; other warnings stay as they are."""
    from graphface.fallback import GraphfaceWarning

    with warnings.catch_warnings():
        warnings.simplefilter("default", GraphfaceWarning)
        otherwise = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
            if issubclass(category, GraphfaceWarning):
                print(f"warning: {message}", file=sys.stderr)
            else:
                otherwise(message, category, *where, **more)

        warnings.showwarning = show
        yield


def _say(message: str) -> None:
    print(f"error: {message}", file=sys.stderr)


def _show_version(wanted: bool) -> None:
    if wanted:
        from graphface import __version__

        print(f"graphface {__version__}")
        raise typer.Exit


def _version(
    version: bool = typer.Option(
        False, "--version", help="Show the version and leave.", is_eager=True, callback=_show_version
    ),
) -> None:
    """An option of the program itself, answered before a command is looked for."""
