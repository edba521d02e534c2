"""What the tests of masks share; lets them import `stages`, which pytest's importlib mode leaves unfindable."""

from __future__ import annotations

import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from graphface.nodes.masks.label_network import WIDTHS
from graphface.nodes.masks.network_input import CHANNELS

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture
def random_weights(rng):
    """Weights of a label network: right shapes, random values."""
    shapes = {"out": (1, WIDTHS[0], 12)}
    for level, (before, width) in enumerate(zip((CHANNELS, *WIDTHS[:-1]), WIDTHS, strict=True)):
        shapes |= {f"down.{level}.0": (3, before, width), f"down.{level}.1": (3, width, width)}
    for level, (width, below) in enumerate(pairwise(WIDTHS)):
        shapes |= {f"across.{level}": (1, below, width), f"up.{level}": (3, width, width)}
    weights = {}
    for layer, (size, inputs, outputs) in shapes.items():
        kernel = rng.normal(size=(size, size, inputs, outputs)) / np.sqrt(size * size * inputs)
        weights[f"{layer}.weight"] = kernel.astype(np.float32)
        weights[f"{layer}.bias"] = rng.normal(0, 0.1, outputs).astype(np.float32)
    return weights
