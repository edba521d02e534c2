"""`check_node` lets a good operator pass and says of a bad one which promise it breaks."""

import random
import re
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
import pytest
from numpy.typing import NDArray
from pydantic import Field, ValidationError

from graphface import ArrayType, Lazy, Needs, UsageError, node
from graphface.testing import check_node

Grid = Annotated[NDArray[np.float64], ArrayType("Grid", "H W")]
GRID = np.arange(12.0).reshape(3, 4)
_buffer = np.zeros((3, 4))
_calls: list[int] = []


@dataclass(frozen=True)
class Stack:
    grids: list[NDArray[np.float64]]
    named: Mapping[str, NDArray[np.float64]]


def _needs(size: int) -> Needs:
    return {"extra": True if size > 1 else "one is enough"}


@node("good.clip", needs=_needs)
def clip(grid: Grid, extra: Lazy[Grid] = None, *, size: Annotated[int, Field(ge=1)] = 1) -> Grid:
    return np.nan_to_num(np.clip(grid, 0, size), posinf=size)


@node("good.refuse", needs=_needs)
def refuse(grid: Grid, extra: Lazy[Grid], *, size: int = 1) -> Grid:
    if not np.isfinite(grid).all():
        raise UsageError("the grid has values that are not numbers")
    return grid * size


@node("good.stack")
def stack(stack: Stack) -> float:
    total = sum(float(np.nansum(g)) for g in [*stack.grids, *stack.named.values()])
    return total if np.isfinite(total) else 0.0


@node("bad.writes")
def writes(grid: Grid) -> Grid:
    grid[0, 0] = 5
    return grid


@node("bad.forces")
def forces(grid: Grid) -> Grid:
    grid.flags.writeable = True
    grid[0, 0] = 5
    return grid.copy()


@node("bad.appends")
def appends(values: list[float]) -> float:
    values.append(1.0)
    return 0.0


@node("bad.draws")
def draws(grid: Grid) -> Grid:
    return grid + random.random()


@node("bad.clock")
def clock(a: float) -> float:
    return float(time.perf_counter_ns())


@node("bad.counts")
def counts(a: float) -> float:
    _calls.append(1)
    return float(len(_calls))


@node("bad.buffer")
def buffer(grid: Grid) -> Grid:
    _buffer[:] = grid
    return _buffer


@node("bad.type")
def wrong_type(grid: Grid) -> Grid:
    return "grid"  # type: ignore[return-value]


@node("bad.shape")
def wrong_shape(grid: Grid) -> Grid:
    return grid[0]


@node("bad.none")
def gives_none(grid: Grid) -> Grid:
    return None  # type: ignore[return-value]


@node("bad.infinite")
def infinite(grid: Grid) -> Grid:
    with np.errstate(divide="ignore"):
        return 1 / grid


@node("bad.spreads")
def spreads(grid: Grid) -> Grid:
    return grid * 2


@node("bad.obscure")
def obscure(grid: Grid) -> Grid:
    return np.eye(3)[[int(v) if np.isfinite(v) else 99 for v in grid[1] * 0], :]


@node("bad.changes")
def changes(grid: Grid) -> Grid:
    return grid if np.isfinite(grid).all() else np.zeros(3)


@node("bad.deep")
def deep(stack: Stack) -> float:
    return float(stack.named["b"].sum())


def _asks_lazy(extra: Any) -> Needs:
    return {}


def _answers_eager(size: int) -> Needs:
    return {"grid": True}


@node("bad.asks", needs=_asks_lazy)
def asks(grid: Grid, extra: Lazy[Grid]) -> Grid:
    return grid


@node("bad.answers", needs=_answers_eager)
def answers(grid: Grid, extra: Lazy[Grid], *, size: int = 1) -> Grid:
    return grid


STACK = Stack([np.ones((2, 2))], {"a": np.ones(3), "b": np.ones(3)})

BAD = {
    "writes to its input": (writes, (GRID,), "writes to an input"),
    "makes its input writable": (forces, (GRID,), "changed one of its inputs"),
    "appends to a list": (appends, ([1.0],), "changed one of its inputs"),
    "draws random numbers": (draws, (GRID,), "two calls gave different results"),
    "reads the clock": (clock, (1.0,), "two calls gave different results"),
    "counts its calls": (counts, (1.0,), "two calls gave different results"),
    "fills one buffer again and again": (buffer, (GRID,), "an output it gave before"),
    "gives another type": (wrong_type, (GRID,), "expected an array"),
    "gives another shape": (wrong_shape, (GRID,), "expected shape"),
    "gives None": (gives_none, (GRID,), "got None"),
    "gives infinity": (infinite, (GRID,), "1 non-finite of 12 values"),
    "fails obscurely on NaN": (obscure, (GRID,), "nan in grid: IndexError"),
    "gives another type on NaN": (changes, (GRID,), "nan in grid: output expected shape"),
    "asks for a lazy port": (asks, (GRID, None), "its rule asks for extra"),
    "answers for an eager port": (answers, (GRID, None), "its rule answers for grid"),
    "has too few inputs": (refuse, (), "takes 1 to 2 inputs, got 0"),
    "has too many inputs": (spreads, (GRID, GRID), "takes 1 to 1 inputs, got 2"),
    "has an input of another type": (spreads, (1.0,), "bad.spreads.grid: expected an array"),
}


class TestGood:
    @pytest.mark.parametrize("size", [1, 3])
    def test_passes(self, size: int) -> None:
        """An operator that keeps its promises passes, and its output comes back."""
        np.testing.assert_array_equal(check_node(clip, GRID, size=size), np.clip(GRID, 0, size))

    def test_refusing(self) -> None:
        """Refusing NaN with a clear error is good too; so are lazy ports and their rule."""
        check_node(refuse, GRID, None, size=1)
        check_node(refuse, GRID, GRID, size=2)

    def test_nested(self) -> None:
        """Arrays in lists and mappings of a dataclass are found."""
        assert check_node(stack, STACK) == 10

    def test_inputs_stay_writable(self) -> None:
        """The caller's arrays are not frozen by the check."""
        mine = GRID.copy()
        check_node(clip, mine)
        mine[0, 0] = 1

    def test_passing_nan_on(self) -> None:
        """NaN in, NaN out is good: the engine's guard sees it there."""
        check_node(spreads, GRID)

    def test_absorbing(self) -> None:
        """An operator that says that it absorbs NaN does."""
        check_node(clip, GRID, absorbs_nan=True)
        check_node(stack, STACK, absorbs_nan=True)


class TestBad:
    @pytest.mark.parametrize(("function", "inputs", "said"), BAD.values(), ids=BAD)
    def test_caught(self, function: Any, inputs: tuple[Any, ...], said: str) -> None:
        """A broken promise is an AssertionError that names the operator and the promise."""
        with pytest.raises(AssertionError) as caught:
            check_node(function, *inputs)
        assert said in str(caught.value)
        assert function.__graphface_operator__.name in str(caught.value)

    @pytest.mark.parametrize(
        ("function", "given", "said"),
        [(spreads, GRID, "nan in grid: output"), (deep, STACK, "nan in stack.named.b: output is nan")],
    )
    def test_does_not_absorb(self, function: Any, given: Any, said: str) -> None:
        """One that says so and does not is caught, by the path of the array that was spoilt."""
        with pytest.raises(AssertionError, match=re.escape(said)):
            check_node(function, given, absorbs_nan=True)

    def test_own_errors(self) -> None:
        """What an operator says about its inputs is not dressed up."""
        with pytest.raises(UsageError, match="not numbers"):
            check_node(refuse, GRID + np.inf, None)

    def test_parameters(self) -> None:
        """Parameters are validated as in a graph."""
        with pytest.raises(ValidationError):
            check_node(clip, GRID, size=0)

    def test_no_operator(self) -> None:
        """A function without `@node` is told so."""
        with pytest.raises(AssertionError, match="not declared with @node"):
            check_node(len, GRID)
