"""Every value has a picture: never an error, never blank, whatever it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from toys import Grid, Pair, toy_registry

from graphface.pictures import draw
from graphface.pictures.colors import NON_FINITE
from graphface.values.picture import Picture, View
from graphface.values.port_types import ANY, ArrayType, PortType, port_type


class Opaque:
    def __repr__(self) -> str:
        raise ValueError("no words either")


@dataclass(frozen=True)
class Nested:
    inner: Any
    words: str = "some"


VALUES = [
    3,
    2.5,
    float("nan"),
    True,
    None,
    "",
    "one word",
    "many words " * 500,
    "line\nline\x00\ufffd",
    b"bytes",
    [],
    {},
    set(),
    {3, 4},
    (1, 2, 3, 4, 5),
    [1.0, float("inf"), -3],
    list(range(1000)),
    [np.zeros((3, 3))] * 100,
    {"a": 1, "b": "text", "c": np.ones((4, 4))},
    {1: {2: {3: {4: {5: 6}}}}},
    Pair(np.ones((3, 3))),
    Nested(Nested(Nested(Nested(np.ones(3))))),
    Opaque(),
    [Opaque()],
    object,
    len,
    np.float32(3),
    np.array("text"),
    np.array([object()]),
    np.array(3.0),
    np.zeros(0),
    np.zeros((0, 5)),
    np.zeros((5, 0, 3)),
    np.ones(1),
    np.ones((1, 1)),
    np.full(7, np.nan),
    np.full((4, 5), np.nan),
    np.full((4, 5, 3), -np.inf),
    np.arange(100_000.0),
    np.ones((2, 5000)),
    np.ones((5000, 2)),
    np.ones((3, 4, 3), np.uint8),
    np.ones((3, 4, 2)),
    np.ones((30, 40, 9)),
    np.ones((3, 40, 50)),
    np.ones((2, 2, 2, 2, 2)),
    np.array([[1 + 2j, 3]]),
    np.array([[True, False]]),
    np.array([[-(2**62), 2**62]]),
    np.full((3, 3), 1e300),
    np.full((3, 3), 1e-300),
]


@pytest.mark.parametrize("size", [None, 1, 40, 384])
@pytest.mark.parametrize("value", VALUES, ids=lambda v: type(v).__name__)
def test_any_value(value: Any, size: int | None) -> None:
    """uint8, three channels, and no larger than asked; what is written in words has a least size."""
    picture = draw(value, ANY, toy_registry(), View(size))
    assert picture.pixels.dtype == np.uint8
    assert picture.pixels.shape[2] == 3
    assert picture.pixels.size
    if size is not None:
        assert max(picture.pixels.shape[:2]) <= max(80, 1.05 * size)


class TestRegistered:
    def test_array_type(self) -> None:
        """What the port declares says what an array means; a type without a drawing is drawn as its parent is."""
        registry = toy_registry()
        registry.add_picture(Grid, lambda value, view: Picture(np.full((2, 2, 3), 7, np.uint8), "mine"))
        assert draw(np.ones((3, 3)), port_type(Grid), registry).note == "mine"
        assert draw(np.ones((3, 3)), ANY, registry).note != "mine"
        assert draw(np.ones(3), port_type(Grid), registry).note != "mine"

    def test_fails(self) -> None:
        """A drawing that raises, or gives no picture, is told in words in the picture's place."""
        for wrong in (np.zeros((2, 2), np.uint8), np.zeros((2, 2, 3)), np.zeros((0, 2, 3), np.uint8)):
            registry = toy_registry()
            registry.add_picture(Pair, lambda value, view, wrong=wrong: Picture(wrong))
            assert draw(Pair(np.ones((2, 2))), port_type(Pair), registry).pixels.size
        registry.add_picture(Pair, lambda value, view: 1 / 0)
        assert draw(Pair(np.ones((2, 2))), port_type(Pair), registry).pixels.size

    def test_fields_and_items(self) -> None:
        """Fields of a record and items of a list are drawn by their own types."""
        drawn = []

        def see(value: Any, view: View) -> Picture:
            drawn.append(value.shape)
            return Picture(np.full((2, 2, 3), 9, np.uint8))

        registry = toy_registry()
        registry.add_picture(Grid, see)
        draw(Pair(np.ones((2, 3)), np.ones((4, 5))), port_type(Pair), registry)
        draw([np.ones((6, 7))], port_type(list[Grid]), registry)
        assert drawn == [(2, 3), (4, 5), (6, 7)]

    def test_record_lies_above_its_fields(self) -> None:
        """A field is drawn over the other fields of its record, before what the record was made from."""
        seen = []
        registry = toy_registry()
        registry.add_picture(Grid, lambda value, view: seen.append(view.above(str)) or draw(1, ANY, registry))
        draw({"a": "inner"}, ANY, registry)
        draw(Nested(Pair(np.ones((2, 2))), "inner"), ANY, registry, View(above=lambda kind: "outer"))
        assert set(seen) == {"inner"}


class TestArrays:
    def test_scale(self) -> None:
        """From smallest to largest, around mid grey where there are both signs; the note says so."""
        picture = draw(np.array([[0.0, 1, 4]]), ANY, toy_registry())
        assert picture.pixels[0, :, 0].tolist() == [0, 64, 255]
        assert picture.note == "black is 0, white 4"
        picture = draw(np.array([[-1.0, 0, 4]]), ANY, toy_registry())
        assert picture.pixels[0, 1, 0] == 128
        assert picture.note == "mid grey is 0, black -4, white 4"

    def test_not_finite(self) -> None:
        """NaN and infinity are magenta, counted in the note, and do not change the scale of the others."""
        picture = draw(np.array([[0.0, np.nan, 1, -np.inf]]), ANY, toy_registry())
        assert picture.pixels[0].tolist() == [[0, 0, 0], list(NON_FINITE), [255, 255, 255], list(NON_FINITE)]
        assert picture.note.endswith("magenta: not finite (2 pixels)")

    def test_data(self) -> None:
        """The array's own values under each pixel, all channels of them."""
        array = np.random.default_rng(1).normal(size=(50, 90, 5)).astype(np.float32)
        view = View(30)
        picture = draw(array, ANY, toy_registry(), view)
        np.testing.assert_array_equal(picture.data, view.sampled(array))
        assert (picture.full, len(picture.channels)) == ((50, 90), 5)


def test_declared_type_that_the_value_is_not_of() -> None:
    """A value of another type than its port's is drawn as what it is."""
    odd = PortType((ArrayType("Odd", "3 3"),))
    assert draw("text", odd, toy_registry()).pixels.size
