"""A plain typed function becomes an operator; its signature is the whole declaration."""

from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
import pytest
from pydantic import Field, ValidationError

from graphface import Cosmetic, Formerly, Lazy, Registry, node
from graphface.node import Operator, operator_of


@dataclass
class Both:
    first: float
    second: str | None = None


def needs(photo: float, strength: float) -> dict[str, Any]:
    return {}


@node("family.method", version=3, needs=needs)
def declared(
    photo: float,
    mask: np.ndarray | None,
    extra: Lazy[float],
    spare: float = 1.0,
    *,
    strength: Annotated[float, Field(gt=0, le=2)] = 0.5,
    must: int,
    label: Annotated[str, Cosmetic] = "",
) -> Both:
    """Says what it does.

    And more.
    """
    return Both(photo * strength)


@pytest.fixture
def operator() -> Operator:
    found = operator_of(declared)
    assert found is not None
    return found


class TestDeclaration:
    def test_function_is_untouched(self) -> None:
        """The function is called from a notebook or a test as if it were not decorated."""
        assert declared(2.0, None, None, must=1) == Both(1.0)

    def test_undeclared(self) -> None:
        """An ordinary function is no operator."""
        assert operator_of(needs) is None

    def test_names(self, operator: Operator) -> None:
        """Name, family and version are as declared."""
        assert (operator.name, operator.family, operator.version) == ("family.method", "family", 3)
        assert operator.doc.startswith("Says what it does.")
        assert repr(operator) == "Operator('family.method')"

    def test_ports(self, operator: Operator) -> None:
        """Positional arguments are ports; a default or `None` makes one optional."""
        ports = {name: (str(p.type), p.required, p.lazy) for name, p in operator.inputs.items()}
        assert ports == {
            "photo": ("float", True, False),
            "mask": ("ndarray | None", False, False),
            "extra": ("float | None", False, True),
            "spare": ("float", False, False),
        }

    def test_outputs(self, operator: Operator) -> None:
        """The return annotation is the output, the fields of a dataclass are its ports."""
        assert str(operator.output) == "Both"
        assert {name: str(t) for name, t in operator.outputs.items()} == {"first": "float", "second": "str | None"}

    def test_cosmetic(self, operator: Operator) -> None:
        """Cosmetic parameters are known."""
        assert operator.cosmetic == {"label"}

    def test_rule(self, operator: Operator) -> None:
        """What the `needs` rule asks to see is known."""
        assert operator.rule_arguments == ("photo", "strength")

    def test_left_open(self, operator: Operator) -> None:
        """Optional ports without a default are given None."""
        assert operator.needs_none == ("mask", "extra")

    def test_renamed(self) -> None:
        """Old names of ports and parameters are known, wherever in the annotation they stand."""

        @node("x.y", needs=needs)
        def many(
            a: Annotated[float, Formerly("first", "one")],
            b: Lazy[Annotated[float, Formerly("second")]],
            *,
            c: Annotated[int, Formerly("third", "a")] | None = None,
        ) -> int:
            return 1

        found = operator_of(many)
        assert found is not None
        assert found.renamed == {"first": "a", "one": "a", "second": "b", "third": "c"}  # `a` is in use


class TestParameters:
    def test_defaults(self, operator: Operator) -> None:
        """Keyword-only arguments are parameters with their defaults."""
        assert operator.parameters(must=1).model_dump() == {"strength": 0.5, "must": 1, "label": ""}

    @pytest.mark.parametrize(
        "values", [{}, {"must": "x"}, {"must": 1, "strength": 0}, {"must": 1, "strength": 3}, {"must": 1, "other": 1}]
    )
    def test_refused(self, operator: Operator, values: dict[str, Any]) -> None:
        """Missing, wrong, out of range and unknown parameters are refused."""
        with pytest.raises(ValidationError):
            operator.parameters(**values)

    @pytest.mark.parametrize("value", [float("nan"), float("inf")])
    def test_not_finite(self, operator: Operator, value: float) -> None:
        """A parameter is finite."""
        with pytest.raises(ValidationError):
            operator.parameters(must=1, strength=value)

    def test_default_is_checked(self) -> None:
        """So is its default."""

        @node("x.y")
        def wrong(*, a: Annotated[int, Field(gt=0)] = 0) -> int:
            return a

        found = operator_of(wrong)
        assert found is not None
        with pytest.raises(ValidationError):
            found.parameters()


def test_registered(registry: Registry) -> None:
    """A declared function joins a registry by its name."""
    registry.add(declared)
    assert registry.operator("family.method").function is declared
