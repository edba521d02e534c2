"""Finished detail maps."""

from __future__ import annotations

import numpy as np
import pytest
from shapes import eyes_apart

from graphface.nodes.detail.additive import additive
from graphface.nodes.detail.split import split
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.types import Image


@pytest.fixture(params=[additive, split])
def made(request, rng):
    """A detail map with a highlight, of either kind."""
    pixels = rng.random((40, 50, 3)).astype(np.float32) / 2
    pixels[10:20, 8:18] += 0.5
    photo = Image(pixels)
    return request.param(photo, intensity(photo).albedo, np.full((40, 50), 0.5, np.float32))


@pytest.fixture
def landmarks():
    return eyes_apart(100)
