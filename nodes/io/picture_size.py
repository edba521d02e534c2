"""How large a picture may be: checked on what its header says, before anything is allocated.

Two limits: pixels (GRAPHFACE_MAX_PIXELS) and the memory that reading them takes (GRAPHFACE_MAX_PICTURE_MEMORY, and what
is free). A file of a few kilobytes can claim any size, so what it takes on the disk says nothing.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from graphface import UnreadableFile, warn
from graphface.settings import parse_size

LIMIT_VARIABLE = "GRAPHFACE_MAX_PIXELS"


DEFAULT_LIMIT = 200_000_000
"""Pixels."""


MEMORY_VARIABLE = "GRAPHFACE_MAX_PICTURE_MEMORY"


DEFAULT_MEMORY = 2_000_000_000
"""Bytes. A JPEG of 100 million pixels takes that much while it is read."""


_SHARE = 0.8
"""Of the free memory, what reading one picture may take."""


def check_size(path: Path, width: int, height: int, bytes_per_pixel: float) -> None:
    """See that a picture may be read.

    Args:
        width, height: as its header says.
        bytes_per_pixel: what reading takes at its height, per pixel.

    Raises:
        UnreadableFile: it has more pixels, or takes more memory, than is allowed or there is.
    """
    pixels = width * height
    limit = pixel_limit()
    if pixels > limit:
        allow = f"more than {limit / 1e6:.0f} million; set {LIMIT_VARIABLE} to allow it"
        raise UnreadableFile(path, f"claims {width} x {height} pixels, {allow}")
    needed = pixels * bytes_per_pixel
    takes = f"reading its {width} x {height} pixels takes about {needed / 1e9:.1f} GB of memory"
    allowed = memory_limit()
    if needed > allowed:
        raise UnreadableFile(path, f"{takes}, more than {allowed / 1e9:.1f} GB; set {MEMORY_VARIABLE} to allow it")
    free = free_memory()
    if free is not None and needed > _SHARE * free:
        raise UnreadableFile(path, f"{takes}, and {free / 1e9:.1f} GB are free; make it smaller")


def pixel_limit() -> int:
    """The most pixels a picture may have: $GRAPHFACE_MAX_PIXELS, or 200 million."""
    text = os.environ.get(LIMIT_VARIABLE, "")
    try:
        return max(1, int(float(text))) if text else DEFAULT_LIMIT
    except (ValueError, OverflowError):
        warn(f"{LIMIT_VARIABLE}={text!r} is not a number: {DEFAULT_LIMIT} is used")
        return DEFAULT_LIMIT


def memory_limit() -> int:
    """The most bytes that reading a picture may take: $GRAPHFACE_MAX_PICTURE_MEMORY ("4G"), or 2 GB."""
    text = os.environ.get(MEMORY_VARIABLE, "")
    try:
        return parse_size(text) if text else DEFAULT_MEMORY
    except ValueError:
        warn(f"{MEMORY_VARIABLE}={text!r} is not a size: 2G is used")
        return DEFAULT_MEMORY


def free_memory() -> int | None:
    """Bytes that this process can still have: of the machine, of its control group and of its own limit; None where the
    system says nothing."""
    found = [size for size in (_free_on_machine(), _free_in_group(), _free_in_process()) if size is not None]
    return min(found, default=None)


def _free_on_machine() -> int | None:
    with suppress(OSError, ValueError, IndexError):
        for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) * 1024
    return None


def _free_in_group() -> int | None:
    with suppress(OSError, ValueError):
        group = Path("/sys/fs/cgroup")
        most = (group / "memory.max").read_text(encoding="ascii").strip()
        if most != "max":
            lines = (group / "memory.stat").read_text(encoding="ascii").splitlines()
            files = sum(int(line.split()[1]) for line in lines if line.startswith("inactive_file "))  # given back first
            taken = int((group / "memory.current").read_text(encoding="ascii")) - files
            return max(0, int(most) - taken)
    return None


def _free_in_process() -> int | None:
    with suppress(ImportError, OSError, ValueError, IndexError):
        import resource

        most, _ = resource.getrlimit(resource.RLIMIT_AS)
        if most != resource.RLIM_INFINITY:
            pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
            return max(0, most - pages * resource.getpagesize())
    return None
