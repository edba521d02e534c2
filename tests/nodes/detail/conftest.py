"""Photos that are hard on a detail map."""

from __future__ import annotations

import numpy as np
import pytest

from graphface.nodes.types import Image

PHOTOS = {
    "black": lambda rng: np.zeros((6, 5, 3)),
    "white": lambda rng: np.ones((6, 5, 3)),
    "flat": lambda rng: np.full((6, 5, 3), (0.7, 0.4, 0.3)),
    "saturated": lambda rng: (rng.random((6, 5, 3)) > 0.5).astype(float),
    "noise": lambda rng: rng.random((6, 5, 3)),
    "dim": lambda rng: rng.random((6, 5, 3)) / 255,
    "brighter than white": lambda rng: rng.random((6, 5, 3)) * 3,
}


@pytest.fixture(params=PHOTOS)
def photo(request, rng):
    return Image(PHOTOS[request.param](rng).astype(np.float32))
