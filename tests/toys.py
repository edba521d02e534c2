"""Operators small enough to predict by hand.

Each says when it is called, through `logging`: a counter in this module would be part of the operators' fingerprints,
and calling one would change its key. The label it says is a cosmetic parameter, so that it is in no key either.
"""

import logging
import time
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import ArrayType, Cosmetic, Lazy, Needs, Pack, Registry, node, warn

LOGGER = "graphface-toys"

Label = Annotated[str, Cosmetic]
_GRID = ArrayType("Grid", "H W")
Grid = Annotated[NDArray[np.float64], _GRID]
FineGrid = Annotated[NDArray[np.float64], ArrayType("FineGrid", "H W", parent=_GRID)]


@dataclass(frozen=True)
class Pair:
    """Two grids; `high` may be absent."""

    low: Grid
    high: Grid | None = None


@dataclass(frozen=True)
class Shape:
    name: str = ""


@dataclass(frozen=True)
class Circle(Shape):
    radius: float = 1.0


def called(label: str) -> None:
    logging.getLogger(LOGGER).info(label)


@node("toy.number")
def number(*, value: float = 1.0, label: Label = "number") -> float:
    called(label)
    return value


@node("toy.add")
def add(a: float, b: float = 0.0, *, plus: float = 0.0, label: Label = "add") -> float:
    called(label)
    return a + b + plus


@node("toy.subtract")
def subtract(a: float, b: float = 0.0, *, times: float = 1.0, label: Label = "subtract") -> float:
    called(label)
    return a - times * b


@node("toy.total")
def total(values: list[float], *, label: Label = "total") -> float:
    called(label)
    return float(sum(values))


@node("toy.ranged")
def ranged(a: float, *, count: Annotated[int, Field(ge=1, le=8)] = 1, mode: str = "plain", must: float) -> float:
    return a * count + must


@node("toy.options")
def options(*, table: dict[str, Any] | None = None, items: list[Any] | None = None, anything: Any = None) -> str:
    return "options"


@node("toy.nested")
def nested(*, sizes: dict[str, list[int]] | None = None, mode: Literal["hard", "soft"] = "soft") -> str:
    return "nested"


@node("toy.grid")
def grid(*, size: Annotated[int, Field(ge=1, le=512)] = 4, fill: float = 1.0, label: Label = "grid") -> Grid:
    called(label)
    return np.full((size, size), fill)


@node("toy.fine")
def fine() -> FineGrid:
    return np.ones((4, 4))


@node("toy.scale")
def scale(grid: Grid, *, by: float = 2.0, label: Label = "scale") -> Grid:
    called(label)
    return grid * by


@node("toy.mean")
def mean(grid: Grid, *, label: Label = "mean") -> float:
    called(label)
    return float(grid.mean())


@node("toy.pair")
def pair(grid: Grid, *, both: bool = True, label: Label = "pair") -> Pair:
    called(label)
    return Pair(grid, grid * 2 if both else None)


@node("toy.maybe_pair")
def maybe_pair(grid: Grid, *, give: bool = True) -> Pair | None:
    return Pair(grid) if give else None


@node("toy.takes_none")
def takes_none(grid: Grid | None, *, label: Label = "takes_none") -> float:
    called(label)
    return -1.0 if grid is None else float(grid.sum())


@node("toy.either")
def either(value: Grid | float) -> float:
    return float(np.mean(value))


@node("toy.circle")
def circle(*, radius: float = 1.0) -> Circle:
    return Circle("circle", radius)


@node("toy.name_of")
def name_of(shape: Shape) -> str:
    return shape.name


@node("toy.radius_of")
def radius_of(circle: Circle) -> float:
    return circle.radius


@node("toy.same")
def same(value: Any, *, label: Label = "same") -> Any:
    called(label)
    return value


@node("toy.write")
def write(grid: Grid) -> Grid:
    """Breaks the rule that inputs are not written to."""
    grid[0, 0] = 99.0
    return grid


@node("toy.fail")
def fail(a: float, *, message: str = "it broke", label: Label = "fail") -> float:
    called(label)
    raise ValueError(message)


@node("toy.interrupt")
def interrupt(a: float) -> float:
    raise KeyboardInterrupt


@node("toy.wrong")
def wrong(a: float) -> Grid:
    """Breaks its declaration."""
    return "not a grid"  # type: ignore[return-value]


@node("toy.poison")
def poison(grid: Grid, *, row: int = 0, label: Label = "poison") -> Grid:
    called(label)
    spoilt = grid.copy()
    spoilt[row, 1] = np.nan
    return spoilt


@node("toy.fall_back")
def fall_back(a: float, *, label: Label = "fall_back") -> float:
    called(label)
    warn(f"{a} was too much")
    return a


@node("toy.slow")
def slow(a: float, *, seconds: float = 0.0, label: Label = "slow") -> float:
    called(label)
    time.sleep(seconds)
    return a


def _gate_needs(open: bool) -> Needs:
    return {"extra": True if open else "the gate is shut"}


@node("toy.gate", needs=_gate_needs)
def gate(a: float, extra: Lazy[float], *, open: bool = True, label: Label = "gate") -> float:
    """Its rule looks at a parameter: decided before anything runs."""
    called(label)
    return a if extra is None else a + extra


def _positive_needs(a: float) -> Needs:
    return {"extra": True if a > 0 else "a is not positive"}


@node("toy.positive", needs=_positive_needs)
def positive(a: float, extra: Lazy[float], *, label: Label = "positive") -> float:
    """Its rule looks at a value: decided in the run, unless the value is a graph input."""
    called(label)
    return a if extra is None else a + extra


def _numpy_needs(a: float) -> Needs:
    return {"extra": np.bool_(a > 0)}


@node("toy.numpy_gate", needs=_numpy_needs)
def numpy_gate(a: float, extra: Lazy[float]) -> float:
    return a if extra is None else a + extra


def _broken_needs(a: float) -> Needs:
    raise LookupError("the rule itself is wrong")


@node("toy.broken_rule", needs=_broken_needs)
def broken_rule(a: float, extra: Lazy[float]) -> float:
    return a


PACK = Pack(
    "toys",
    operators={"toy": "toys"},
    types={"Grid": "toys:Grid", "FineGrid": "toys:FineGrid", "Pair": "toys:Pair", "Shape": "toys:Shape"},
)


def toy_registry() -> Registry:
    """The toy operators and types, and nothing that is installed."""
    return Registry([PACK])
