"""Which drawing a value gets."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphface.pictures.arrays import draw_array
from graphface.pictures.card import draw_text
from graphface.registry import Registry
from graphface.values.frozen import describe
from graphface.values.picture import Picture, View
from graphface.values.port_types import ANY, ArrayType, Atom, PortType

ALONE = View()


def draw(value: Any, declared: PortType, registry: Registry, view: View = ALONE) -> Picture:
    """The picture of a value.

    Args:
        declared: the type of its port, which says what an array means.
        registry: where drawings are found.

    Never fails and never gives an empty picture: where a drawing raises, the picture says so in words.
    """
    for kind in _kinds(value, declared):
        drawing = registry.draw(kind)
        if drawing is not None:
            try:
                return drawing(value, view)
            except Exception as error:
                return draw_text(f"no picture: {type(error).__name__}: {error}\n\n{describe(value)}", view)
    if isinstance(value, np.ndarray):
        return draw_array(value, view)
    return draw_text(describe(value), view)


def _kinds(value: Any, declared: PortType = ANY) -> list[Atom]:
    """The array type that the port declares and that the value is of, then its class."""
    arrays: list[Atom] = [a for a in declared.alternatives if isinstance(a, ArrayType) and a.problem(value) is None]
    return [*arrays, type(value)]
