"""`graphface assets`: the files that operators fetch when first needed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from graphface.assets.asset import Asset

app: typer.Typer = typer.Typer(
    help="List, fetch or locate network weights and other pinned files.", no_args_is_help=True
)


@app.command("list")
def list_assets() -> None:
    """Show every asset: its size and where it is."""
    from graphface.assets.asset import asset_status
    from graphface.report.terminal import print_table

    rows = []
    for asset in _assets():
        status = asset_status(asset)
        where = f"{status.place}: {status.path}" if status.path is not None else f"to be fetched ({asset.requirement})"
        rows.append((asset.name, f"{asset.size / 1e6:.1f} MB", asset.extra, where))
    print_table(("asset", ">size", "extra", "where"), rows)


@app.command()
def fetch(
    names: Annotated[
        list[str], typer.Argument(help="Assets to fetch; by default all but those of optional extras.")
    ] = [],  # noqa: B006
) -> None:
    """Fetch assets now, so that later runs need no network."""
    from graphface.assets.asset import asset_path

    for asset in [_named(name) for name in names] or [asset for asset in _assets() if not asset.extra]:
        print(asset_path(asset))


@app.command()
def path(name: Annotated[str, typer.Argument(help="An asset's name.")]) -> None:
    """Print where an asset is, fetching it if needed."""
    from graphface.assets.asset import asset_path

    print(asset_path(_named(name)))


def _assets() -> list[Asset]:
    from graphface.registry import default_registry

    return default_registry().assets()


def _named(name: str) -> Asset:
    from graphface.errors import UsageError

    known = {asset.name: asset for asset in _assets()}
    if name not in known:
        raise UsageError(f"there is no asset {name!r} (there are {', '.join(known)})")
    return known[name]
