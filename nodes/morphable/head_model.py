"""The built-in head with ears, neck and shoulders: ICT-FaceKit reduced (MIT; the notice lies beside this module).

`graphface models head` made it. Its last 468 vertices are FaceMesh's points and belong to no triangle.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.storage import load_model


@cache
def builtin_head() -> MorphableModel:
    """The built-in head, read once."""
    return load_model(Path(__file__).with_name("head.safetensors"))
