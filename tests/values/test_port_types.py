"""Port types: what may travel along a wire, and what may be plugged into what."""

from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
import pytest
from numpy.typing import NDArray
from typing_extensions import TypeAliasType

from graphface import ArrayType, Lazy
from graphface.values.port_types import is_lazy, output_fields, port_type

COARSE = ArrayType("Coarse", "H W")
FINE = ArrayType("Fine", "H W", parent=COARSE)
COLOUR = ArrayType("Colour", "H W 3")
Coarse = Annotated[NDArray[np.float32], COARSE]
Fine = Annotated[NDArray[np.float32], FINE]
Colour = Annotated[NDArray[np.float32], COLOUR]


class Base: ...


class Derived(Base): ...


@dataclass
class Output:
    coarse: Coarse
    maybe: Fine | None


class TestReading:
    @pytest.mark.parametrize(
        ("annotation", "text"),
        [
            (float, "float"),
            (Coarse, "Coarse"),
            (Coarse | None, "Coarse | None"),
            (float | Base | None, "float | Base | None"),
            (list[Coarse], "list[Coarse]"),
            (list[int | None] | None, "list[int | None] | None"),
            (Any, "Any"),
            (Lazy[Coarse], "Coarse | None"),
            (NDArray[np.float32], "ndarray"),
            (dict[str, int], "dict"),
            (Literal["srgb", "linear"], "str"),
            (Literal["largest"] | int, "str | int"),
            (Literal[1, None], "int | None"),
            (TypeAliasType("Alias", Coarse | None), "Coarse | None"),
            (list[TypeAliasType("Alias", NDArray[np.float32])], "list[ndarray]"),
        ],
    )
    def test_annotation(self, annotation: object, text: str) -> None:
        """A port's type is read from an ordinary annotation."""
        assert str(port_type(annotation)) == text

    @pytest.mark.parametrize("annotation", ["text", 3, ...])
    def test_no_type(self, annotation: object) -> None:
        """What is no type cannot be a port's."""
        with pytest.raises(TypeError):
            port_type(annotation)

    def test_lazy(self) -> None:
        """`Lazy[X]` is marked, `X | None` is not."""
        assert is_lazy(Lazy[Coarse])
        assert not is_lazy(Coarse | None)

    def test_fields(self) -> None:
        """The fields of a dataclass are ports of their own."""
        assert {name: str(t) for name, t in output_fields(Output).items()} == {
            "coarse": "Coarse",
            "maybe": "Fine | None",
        }


class TestAccepts:
    @pytest.mark.parametrize(
        ("port", "source", "fits"),
        [
            (float, float, True),
            (float, int, True),
            (int, float, False),
            (float, bool, False),
            (Coarse, Fine, True),
            (Fine, Coarse, False),
            (Coarse, Colour, False),
            (Coarse, NDArray[np.float32], False),
            (NDArray[np.float32], Coarse, True),
            (Base, Derived, True),
            (Derived, Base, False),
            (Coarse | None, Coarse, True),
            (Coarse, Coarse | None, False),
            (float | Coarse, Fine, True),
            (float, float | str, False),
            (Any, Coarse | None, True),
            (object, Coarse | None, False),
            (Coarse, Any, False),
            (list[Coarse], list[Fine], True),
            (list[Fine], list[Coarse], False),
            (list, list[Coarse], True),
        ],
    )
    def test_pairs(self, port: object, source: object, fits: bool) -> None:
        """A port accepts a source whose every value it takes."""
        assert port_type(port).accepts(port_type(source)) == fits


class TestProblem:
    @pytest.mark.parametrize(
        ("annotation", "value", "said"),
        [
            (Coarse, np.zeros((2, 2), np.float32), None),
            (Coarse, np.zeros((2, 2), int), "dtype"),
            (Coarse, np.zeros(2), "shape"),
            (Colour, np.zeros((2, 2, 4)), "shape"),
            (Coarse, [[1.0]], "array"),
            (float, 3, None),
            (float, True, "bool"),
            (int, True, "bool"),
            (float, None, "None"),
            (float | None, None, None),
            (list[float], [1, 2.0], None),
            (list[float], [1, "x"], "str"),
            (list[float], 3, "list[float]"),
            (float | str, b"", "float | str"),
        ],
    )
    def test_values(self, annotation: object, value: object, said: str | None) -> None:
        """Why a value does not fit is said with what was expected and what came."""
        problem = port_type(annotation).problem(value)
        assert (problem is None) == (said is None)
        assert said is None or (problem is not None and said in problem)
