"""What the tests of readers share: a face in a source's own units, written in the format of each by its test."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from graphface.nodes.morphable.builtin import builtin_model

sys.path.insert(0, str(Path(__file__).parent))

SIZE = 90.0
"""Millimetres between the eye corners of the files written here."""


@pytest.fixture(scope="module")
def face():
    """The built-in mean face in millimetres, displaced, with two directions of identity and one of expression."""
    model = builtin_model()
    mean = (model.mean * SIZE + (3, 50, -20)).astype(np.float32)
    identity = model.identity.directions[:2] * np.float32(SIZE)
    expression = model.expression.directions[:1] * np.float32(SIZE)
    return mean, model.triangles, identity, expression, model.landmarks["ibug68"]


@pytest.fixture
def numbers(face, tmp_path):
    """A file with the vertices of the iBUG points."""
    path = tmp_path / "points.txt"
    path.write_text("# iBUG = vertex\n" + "".join(f"{k + 1} = {v}  # a point\n" for k, v in enumerate(face[4])))
    return path
