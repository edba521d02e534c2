"""What is at hand without any data: scikit-image's photograph, and the scenes that come with graphface."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray


def astronaut() -> NDArray[np.uint8]:
    """Eileen Collins (NASA): uint8, 512 x 512 x 3."""
    from skimage.data import astronaut

    photo: NDArray[np.uint8] = astronaut()  # type: ignore[no-untyped-call]
    return photo


def shipped_scenes() -> list[Path]:
    """The scene files, by name."""
    import graphface.graphs

    return sorted((Path(graphface.graphs.__file__ or "").parent / "scenes").glob("*.yaml"))
