"""What is at hand without any data: scikit-image's photograph, and the scenes that come with graphface."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import UsageError
from graphface.errors import did_you_mean, nearest_names


def astronaut() -> NDArray[np.uint8]:
    """Eileen Collins (NASA): uint8, 512 x 512 x 3."""
    from skimage.data import astronaut

    photo: NDArray[np.uint8] = astronaut()  # type: ignore[no-untyped-call]
    return photo


def shipped_scenes() -> list[Path]:
    """The scene files, by name."""
    import graphface.graphs

    return sorted((Path(graphface.graphs.__file__ or "").parent / "scenes").glob("*.yaml"))


def scene_file(name: str) -> Path:
    """A scene by the name of a shipped one, or by its path.

    Raises:
        UsageError: it is neither.
    """
    shipped = {path.stem: path for path in shipped_scenes()}
    if name in shipped:
        return shipped[name]
    if not Path(name).is_file():
        raise UsageError(f"no scene {name!r}: neither shipped nor a file{did_you_mean(nearest_names(name, shipped))}")
    return Path(name)
