"""What is said about types: found by the nearest base, the last word that of whoever added it."""

from typing import Any

import pytest
from toys import _GRID, Circle, FineGrid, Grid, Pair, Shape

from graphface import Pack
from graphface.type_table import TypeTable
from graphface.values.port_types import Atom, array_of, port_type

PACK = Pack(
    "toys",
    operators={},
    types={"Pair": "toys:Pair", "Shape": "toys:Shape", "Grid": "toys:Grid"},
    files={"Pair": "things:PAIR", "Shape": "things:TABLE", "Grid": "things:GRID"},
)
THINGS: dict[str, Any] = {
    "toys:Pair": Pair,
    "toys:Shape": Shape,
    "toys:Grid": Grid,
    "things:PAIR": "how pairs are",
    "things:TABLE": {Shape: "how shapes are"},
    "things:GRID": "how grids are",
}


@pytest.fixture
def table() -> TypeTable[str]:
    return TypeTable([PACK], lambda pack: pack.files, THINGS.get)


def atom(annotation: Any) -> Atom:
    return port_type(annotation).alternatives[0]


class TestNearest:
    @pytest.mark.parametrize(
        ("kind", "said_of", "thing"),
        [
            (Pair, Pair, "how pairs are"),
            (Shape, Shape, "how shapes are"),
            (Circle, Shape, "how shapes are"),
            (Grid, Grid, "how grids are"),
            (FineGrid, Grid, "how grids are"),
        ],
    )
    def test_base(self, table: TypeTable[str], kind: Any, said_of: Any, thing: str) -> None:
        """A type that nothing is said about has what is said about its nearest base or parent."""
        assert table.nearest(atom(kind)) == (atom(said_of), thing)

    def test_nothing(self, table: TypeTable[str]) -> None:
        """Nobody says anything about numbers."""
        assert table.nearest(float) is None

    def test_own_name_only(self) -> None:
        """To answer for one type, no module of another is imported."""
        asked: list[str] = []
        table: TypeTable[str] = TypeTable([PACK], lambda p: p.files, lambda w: (asked.append(w), THINGS.get(w))[1])
        table.nearest(Pair)
        assert asked == ["toys:Pair", "things:PAIR"]


class TestAdded:
    def test_wins(self, table: TypeTable[str]) -> None:
        """What is added counts before what packs say, also where a pack was asked already."""
        table.nearest(Circle)
        table.add(Circle, "how circles are")
        assert table.nearest(Circle) == (Circle, "how circles are")
        assert table.nearest(Shape) == (Shape, "how shapes are")

    def test_array_type(self, table: TypeTable[str]) -> None:
        """An array's annotation and its `ArrayType` are one type."""
        table.add(FineGrid, "finer")
        assert array_of(FineGrid) is not None
        assert table.nearest(atom(FineGrid)) == (array_of(FineGrid), "finer")
        assert table.nearest(_GRID) == (_GRID, "how grids are")

    def test_taken_over(self, table: TypeTable[str]) -> None:
        """Another table can take over what was added, and changes nothing in this one."""
        table.add(Pair, "mine")
        other: TypeTable[str] = TypeTable([PACK], lambda pack: pack.files, THINGS.get)
        other.add_all(table)
        other.add(Shape, "other's")
        assert other.nearest(Pair) == (Pair, "mine")
        assert table.nearest(Shape) == (Shape, "how shapes are")

    def test_all(self, table: TypeTable[str]) -> None:
        """Everything that is said, what was added first."""
        table.add(Circle, "how circles are")
        assert list(table.all()) == ["how circles are", "how pairs are", "how shapes are", "how grids are"]
