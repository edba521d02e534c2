"""The built-in face model: 468 FaceMesh points, learned by `graphface models learn`, subdivided once when read."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.storage import load_model

BUILTIN = Path(__file__).with_name("builtin.safetensors")


@cache
def builtin_model() -> MorphableModel:
    """The built-in model, read once; the card beside it gives its training data and its limits."""
    return load_model(BUILTIN)
