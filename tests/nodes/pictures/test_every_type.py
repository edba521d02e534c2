"""Every type of the pack has a picture: none is missing, none is empty, what lies under a pixel is exact."""

from __future__ import annotations

import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))

from values import EXACT, HEIGHT, VALUES, WIDTH, colors

from graphface.nodes.types import Image
from graphface.pictures import draw
from graphface.registry import default_registry
from graphface.values.frozen import with_arrays
from graphface.values.picture import Picture, View
from graphface.values.port_types import ArrayType, ListOf, PortType

REGISTRY = default_registry()
PHOTO = Image(colors())
OVER_PHOTO = View(20, lambda kind: PHOTO if kind is Image else None)
BY_ENGINE = {"FileFormat", "Hair", "Representation", "Window", "float", "int", "ndarray", "str", "tuple"}
"""Numbers, texts, plain arrays, and records whose fields the engine puts beside each other."""


def named(name: str) -> PortType:
    from graphface.nodes.masks.hair import Hair
    from graphface.nodes.masks.window import Window
    from graphface.nodes.types import FileFormat

    others: dict[str, type] = {"Hair": Hair, "Window": Window, "FileFormat": FileFormat}
    return PortType((others[name],)) if name in others else REGISTRY.type(name)


def drawn(name: str, value: Any, view: View) -> Picture:
    picture = draw(value, named(name), REGISTRY, view)
    assert picture.pixels.dtype == np.uint8
    assert picture.pixels.ndim == 3
    assert picture.pixels.shape[2] == 3
    assert picture.pixels.size
    if picture.data is not None:
        assert picture.data.shape[:2] == picture.pixels.shape[:2]
        assert len(picture.channels) == (1 if picture.data.ndim == 2 else picture.data.shape[2])
    return picture


def test_none_is_missing() -> None:
    """Whatever an operator returns, and each of its fields, has a drawing, unless the engine knows what it is."""
    missing = set()
    for operator in REGISTRY.operators():
        for declared in (operator.output, *operator.outputs.values()):
            atoms = [item for atom in declared.alternatives for item in _atoms(atom)]
            missing |= {atom for atom in atoms if REGISTRY.draw(atom) is None}
    names = {atom.name if isinstance(atom, ArrayType) else atom.__name__ for atom in missing}
    assert names <= BY_ENGINE


def _atoms(atom: Any) -> list[Any]:
    return list(atom.item.alternatives) if isinstance(atom, ListOf) else [atom]


@pytest.mark.parametrize("name", VALUES)
class TestEveryType:
    def test_picture(self, name: str) -> None:
        """A picture with something in it, and words for its colors; at any size, with and without a photo."""
        for view in (View(), View(12), View(200), View(384, OVER_PHOTO.above), View(1)):
            picture = drawn(name, VALUES[name](), view)
            assert picture.note or name in ("FileFormat",)
            assert "no picture" not in picture.note
            assert len(np.unique(picture.pixels)) > 1 or view.size == 1

    def test_no_error_card(self, name: str) -> None:
        """The drawing itself does not fail."""
        drawing = REGISTRY.draw(named(name).alternatives[0])
        if drawing is not None:
            drawing(VALUES[name](), OVER_PHOTO)

    def test_not_finite(self, name: str) -> None:
        """NaN and infinity everywhere make a picture too."""
        for odd in (np.nan, np.inf):
            value = with_arrays(VALUES[name](), lambda a, odd=odd: np.full_like(a, odd) if a.dtype.kind == "f" else a)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", RuntimeWarning)
                drawn(name, value, OVER_PHOTO)

    def test_nothing_in_it(self, name: str) -> None:
        """Empty arrays, and maps of one pixel."""
        value = VALUES[name]()
        for size in (0, 1):
            drawn(name, with_arrays(value, lambda a, n=size: _cut(a, n)), OVER_PHOTO)

    def test_value_is_left_alone(self, name: str) -> None:
        """A drawing writes to no array of its value."""
        value = with_arrays(VALUES[name](), _frozen)
        drawn(name, value, OVER_PHOTO)


def _cut(array: np.ndarray, size: int) -> np.ndarray:
    """The first rows of a table, the corner of a map."""
    return array[:size] if array.ndim == 1 or array.shape[1] <= 4 else array[:size, :size]


def _frozen(array: np.ndarray) -> np.ndarray:
    array = array.copy()
    array.flags.writeable = False
    return array


@pytest.mark.parametrize("name", EXACT)
@pytest.mark.parametrize("size", [None, 20])
def test_data_is_exact(name: str, size: int | None) -> None:
    """Under a pixel lies the value that the array has there, in its own type."""
    value = VALUES[name]()
    view = View(size, OVER_PHOTO.above)
    picture, array = drawn(name, value, view), EXACT[name](value)
    assert picture.data is not None
    assert picture.data.dtype == array.dtype
    np.testing.assert_array_equal(picture.data, view.sampled(array))
    assert picture.full == array.shape[:2]
    assert picture.full == (HEIGHT, WIDTH) or name in ("Environment", "Texture")
