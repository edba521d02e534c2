"""A function that cannot be an operator gets a sentence: where it is, what is wrong, what to write."""

from collections.abc import Callable
from typing import Any, TypeVar

import pytest

from graphface import DeclarationError, DocumentError, Lazy, Registry, load, node
from graphface.node import operator_of

T = TypeVar("T")


class Odd:
    """No type that pydantic can check."""


def bare(a, *, b=1):  # type: ignore[no-untyped-def]
    return a


def many(*values: float, **more: float) -> float:
    return 0.0


def positional(a: float, /) -> float:
    return a


def unresolved(a: "Imag", b: float) -> float:  # type: ignore[name-defined] # noqa: F821
    return b


def lazy(a: float, b: Lazy[float]) -> float:
    return a


def no_type(a: 3) -> T:  # type: ignore[valid-type]
    return a


def odd(a: float, *, good: int = 1, rule: Odd) -> float:
    return a


def refused(function: Callable[..., Any]) -> DeclarationError:
    operator = operator_of(node("mine.method")(function))
    assert operator is not None
    with pytest.raises(DeclarationError) as caught:
        operator.check()
    return caught.value


@pytest.mark.parametrize(
    ("function", "wrong"),
    [
        (bare, {"a": "'a: Image'", "b": "'b: float'", "return": "'-> Image'"}),
        (many, {"values": "list[X]", "more": "behind a '*'"}),
        (positional, {"a": "'/'"}),
        (unresolved, {"a": "name 'Imag' is not defined"}),
        (lazy, {"b": "needs=rule"}),
        (no_type, {"a": "cannot have the type 3", "return": "cannot have the type ~T"}),
        (odd, {"rule": "make it a port"}),
    ],
)
def test_wrong(function: Callable[..., Any], wrong: dict[str, str]) -> None:
    """Every argument that is wrong is named, with what to write."""
    error = refused(function)
    assert [argument.name for argument in error.wrong] == list(wrong)
    assert all(part in argument.reason for part, argument in zip(wrong.values(), error.wrong, strict=True))


def test_sentence() -> None:
    """The sentence says which operator, in which file and line."""
    error = refused(bare)
    line = bare.__code__.co_firstlineno
    assert (error.operator, error.file, error.line) == ("mine.method", __file__, line)
    assert str(error).startswith(f"{__file__}:{line}: operator 'mine.method': argument 'a': it has no annotation")
    assert isinstance(error, TypeError)


class TestInAGraph:
    def test_place(self, registry: Registry) -> None:
        """A graph that uses it is refused at the place of its name, among everything else that is wrong."""
        registry.add(node("mine.bare")(bare))
        text = "graphface: 1\nnodes:\n  n: {use: mine.bare}\n  m: {use: toy.nothing}\n"
        with pytest.raises(DocumentError) as caught:
            load(text, registry=registry)
        first, second = caught.value.problems
        assert "argument 'a'" in first.message
        assert (first.place and first.place.line, second.place and second.place.line) == (3, 4)

    def test_others_work(self, registry: Registry) -> None:
        """The operators beside it work, and it is left out where all are listed."""
        registry.add(node("toy.bare")(bare))
        assert "toy.subtract" in {other.name for other in registry.alternatives(registry.operator("toy.add"))}
        with pytest.warns(UserWarning, match=r"toy\.bare"):
            assert "toy.bare" not in {operator.name for operator in registry.operators()}
