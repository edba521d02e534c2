"""What goes into a file comes out of it, and nothing is built that the annotation does not name."""

import json
from contextlib import suppress
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray
from pydantic import BaseModel
from typing_extensions import TypeAliasType

from graphface import ArrayType
from graphface.nodes.types import Image, Intrinsic, Lighting, LightingFit, Mask
from graphface.values.codec import CodecError, decode, encode
from graphface.values.digest import digest_value

plain = st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.binary() | st.complex_numbers()
arrays = hnp.arrays(hnp.scalar_dtypes(), hnp.array_shapes(min_dims=0, min_side=0, max_side=4))
values = st.recursive(
    plain | arrays | arrays.map(lambda a: a.reshape(-1)[0] if a.size else None),
    lambda inner: st.lists(inner) | st.tuples(inner, inner) | st.dictionaries(st.text() | st.integers(), inner),
    max_leaves=8,
)


def round_trip(value: Any, annotation: Any) -> Any:
    tensors, structure = encode(value)
    return decode(tensors, json.loads(json.dumps(structure)), annotation)


class Kind(Enum):
    KEY = 1
    FILL = 2


class Point(NamedTuple):
    x: float
    y: float


class Lamp(BaseModel):
    power: float
    kind: Kind = Kind.KEY
    map: Path | None = None


class Loose(BaseModel, extra="allow"):
    name: str


@dataclass(frozen=True)
class Base:
    pixels: NDArray[np.float32]


@dataclass(frozen=True)
class Derived(Base):
    gain: float = 1.0


@dataclass(frozen=True)
class Twin:
    pixels: NDArray[np.float32]


@dataclass
class Made:
    given: int
    derived: int = field(init=False, default=0)

    def __post_init__(self) -> None:
        self.derived = self.given + 1


class TestRoundTrip:
    @given(values)
    def test_plain_values(self, value):
        """Scalars, arrays of any dtype and containers of them come back the same, type by type."""
        assert digest_value(round_trip(value, Any)) == digest_value(value)

    @given(arrays)
    def test_arrays_exactly(self, array):
        """dtype, shape and every bit, NaN payloads included."""
        back = round_trip(array, np.ndarray)
        assert (back.dtype, back.shape, back.tobytes()) == (array.dtype, array.shape, array.tobytes())

    @pytest.mark.parametrize(
        ("value", "annotation"),
        [
            (Kind.FILL, Kind),
            (Point(1.0, 2.0), Point),
            (Lamp(power=2.0, map=Path("a/b")), Lamp),
            (Loose(name="a", more=[1, 2]), Loose),
            ([Lamp(power=1.0)], list[Lamp]),
            ({"a": (Kind.KEY, 1)}, dict[str, tuple[Kind, int]]),
            ((Kind.KEY, Kind.FILL), tuple[Kind, ...]),
            ("soft", Literal["soft", "hard"]),
            (None, Lamp | None),
            (Lamp(power=1.0), TypeAliasType("Alias", Lamp | None)),
            (Lamp(power=1.0), Loose | Lamp | None),
            (3, float),
            (np.float32(0.1), float),
            pytest.param(10**5000, int, id="huge"),
            ("\ud800", str),
            (Made(3), Made),
        ],
    )
    def test_declared_types(self, value, annotation):
        """Enums, named tuples, models, unions and literals follow the annotation."""
        back = round_trip(value, annotation)
        assert back == value
        assert type(back) is type(value)

    def test_operator_outputs(self):
        """Dataclasses of arrays nest."""
        fit = LightingFit(Lighting(np.ones((4, 3), np.float32)), np.zeros((5, 6), np.float32), 12.5)
        back = round_trip(fit, LightingFit)
        assert digest_value(back) == digest_value(fit)

    def test_file_blocks(self):
        """An image keeps its alpha, its encoding and the raw blocks of its file."""
        from graphface.nodes.types import FileFormat

        pixels = np.random.default_rng(0).random((4, 5, 3), dtype=np.float32)
        image = Image(pixels, pixels[..., 0], "linear", FileFormat("JPEG", 8, icc=b"\x00\xff", exif=None))
        back = round_trip(image, Image)
        assert digest_value(back) == digest_value(image)

    def test_subclass_of_the_annotation(self):
        """A value may be of a loaded subclass of what is declared."""
        back = round_trip(Derived(np.ones(2, np.float32), 3.0), Base)
        assert type(back) is Derived
        assert back.gain == 3.0

    def test_arrays_are_read_only(self):
        """A decoded array cannot be written into."""
        back = round_trip({"a": np.ones(3)}, dict[str, Any])
        with pytest.raises(ValueError, match="read-only"):
            back["a"][0] = 2

    def test_shared_array_is_stored_once(self):
        """Two fields with one array take one tensor."""
        shared = np.ones(3, np.float32)
        assert len(encode(Intrinsic(shared, shared))[0]) == 1

    def test_strided_arrays(self):
        """A transposed or reversed view is stored by value."""
        array = np.arange(24.0).reshape(2, 3, 4)[::-1].transpose(2, 0, 1)
        np.testing.assert_array_equal(round_trip(array, np.ndarray), array)


class TestRefusals:
    @pytest.mark.parametrize(
        "value",
        [object(), len, {1, 2}, np.array([None]), np.ma.masked_array([1.0]), [{"a": open}], type("S", (str,), {})()],
    )
    def test_not_storable(self, value):
        """What cannot be told completely by arrays and JSON is refused when stored."""
        with pytest.raises(CodecError):
            encode(value)

    def test_names_the_place(self):
        """The error says which field."""
        with pytest.raises(CodecError, match=r"\.shading") as caught:
            encode(Intrinsic(np.ones(1, np.float32), object()))
        assert caught.value.where == ".shading"

    @pytest.mark.parametrize(
        ("value", "annotation"),
        [
            (Base(np.ones(2, np.float32)), Twin),
            (Base(np.ones(2, np.float32)), Any),
            (Base(np.ones(2, np.float32)), Derived),
            (Lamp(power=1.0), Loose),
            (Kind.KEY, Any),
            ("other", Literal["soft", "hard"]),
            ("3", int),
            (np.ones((2, 3), np.float32), Image),
            (np.ones((2, 3, 4), np.float32), Mask),
            (np.ones(3), Annotated[NDArray[np.int32], ArrayType("Index", "N", kind="i")]),
            (None, Lamp),
            ((1, 2, 3), tuple[int, int]),
        ],
    )
    def test_not_what_is_declared(self, value, annotation):
        """A stored value of another type than declared is refused when read."""
        with pytest.raises(CodecError):
            round_trip(value, annotation)

    @pytest.mark.parametrize("fields", [{}, {"pixels": {"array": "0"}, "more": 1}])
    def test_other_fields(self, fields):
        """Missing and unknown fields are refused."""
        name = f"{Base.__module__}.Base"
        with pytest.raises(CodecError, match="other fields"):
            decode({"0": np.ones(1, np.float32)}, {"record": name, "fields": fields}, Base)

    @given(
        st.recursive(
            st.none() | st.integers() | st.text(),
            lambda inner: (
                st.lists(inner)
                | st.dictionaries(
                    st.sampled_from(
                        ["array", "record", "fields", "list", "dict", "scalar", "dtype", "enum", "int", "path"]
                    ),
                    inner,
                )
            ),
        ),
        st.sampled_from([Any, Image, list[int], Kind, Lamp, Mask, Point | None]),
    )
    def test_any_structure(self, structure, annotation):
        """A structure from a foreign hand gives a value or a CodecError, never another exception."""
        with suppress(CodecError):
            decode({"0": np.ones(2)}, structure, annotation)
