"""A picture whose albedo and shading are known: a patchwork of flat colors under a smooth light."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from graphface.nodes.types import FloatArray, Image


@dataclass(frozen=True)
class Patchwork:
    photo: Image
    albedo: FloatArray
    shading: FloatArray


@pytest.fixture(scope="session")
def patchwork():
    """Make one: `patches` to a side, of `colors` different colors."""

    def make(patches: int = 32, colors: int = 6, size: int = 128) -> Patchwork:
        rng = np.random.default_rng(3)
        palette = rng.uniform(0.3, 0.95, (colors, 3)).astype(np.float32)
        layout = palette[rng.integers(0, colors, (patches, patches))]
        albedo = np.kron(layout, np.ones((size // patches, size // patches, 1), np.float32))
        y, x = np.mgrid[0:size, 0:size] / size
        shading = (0.35 + 0.6 * np.exp(-((x - 0.3) ** 2 + (y - 0.4) ** 2) / 0.25)).astype(np.float32)
        return Patchwork(Image(albedo * shading[..., None]), albedo, shading)

    return make
