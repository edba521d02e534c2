"""`graphface cache`: look after a disk cache."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphface.cli.options import CacheSize, open_cache

app: typer.Typer = typer.Typer(help="Show, check or empty a disk cache (the folder of --cache).", no_args_is_help=True)
Folder = Annotated[
    Path | None, typer.Option("--cache", metavar="DIR", envvar="GRAPHFACE_CACHE", help="The cache folder.")
]


@app.command()
def stats(folder: Folder = None, cache_size: CacheSize = None) -> None:
    """Show how many entries and bytes the cache holds."""
    found = open_cache(_given(folder), [], cache_size).stats()
    print(f"{found.folder}: {found.entries} entries, {found.bytes / 1e6:.1f} of {found.budget_bytes / 1e6:.0f} MB")


@app.command()
def clear(folder: Folder = None) -> None:
    """Delete every entry."""
    print(f"freed {open_cache(_given(folder), []).clear() / 1e6:.1f} MB")


@app.command()
def verify(
    folder: Folder = None,
    drop: Annotated[bool, typer.Option("--drop", help="Delete damaged entries.")] = False,
) -> None:
    """Read every entry and compare checksums; exit code 1 where one is damaged."""
    report = open_cache(_given(folder), []).verify(drop=drop)
    for path, reason in report.damaged:
        print(f"damaged: {path}: {reason}")
    for path in report.foreign:
        print(f"not an entry: {path}")
    print(f"{report.intact} intact, {len(report.damaged)} damaged")
    if report.damaged and not drop:
        raise typer.Exit(1)


def _given(folder: Path | None) -> Path:
    from graphface.errors import UsageError

    if folder is None:
        raise UsageError("which cache? add --cache DIR, or set GRAPHFACE_CACHE")
    return folder
