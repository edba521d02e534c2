"""What names in graph files mean: own nodes, fields, outputs and nodes of graphs that are used as nodes."""

from collections.abc import Callable
from pathlib import Path

import pytest

from graphface import DocumentError, Graph

INNER = "inputs: {a: float}\nnodes: {sum: {use: toy.add, in: {a: a}, with: {plus: 1}}}\noutputs: {out: sum}\n"
OUTER = (
    "inputs: {x: {type: float, default: 1}}\nnodes:\n  g: {use: inner.yaml, in: {a: x}}\n"
    "  n: {use: toy.add, in: {a: REFERENCE}}\n"
)


@pytest.fixture
def meaning(write: Callable[..., Path], opened: Callable[..., Graph]) -> Callable[[str], list[str]]:
    """What is plugged into the node behind a reference, by name in the flat graph."""

    def of(reference: str) -> list[str]:
        write("inner.yaml", INNER)
        graph = opened(write("outer.yaml", OUTER.replace("REFERENCE", reference)))
        (step,) = (step for step in graph.steps if step.name == "n")
        return [graph.names[ref.slot] for argument in step.arguments for ref in argument.refs]

    return of


class TestReferences:
    @pytest.mark.parametrize("reference", ["g.out", "g/sum", "g"])
    def test_found(self, meaning: Callable[[str], list[str]], reference: str) -> None:
        """An output of a used graph (its only one needs no name), a node inside it; an input is its own."""
        assert meaning(reference) == ["g/sum"]
        assert meaning("x") == ["x"]

    @pytest.mark.parametrize(("reference", "nearest"), [("g.uot", "out"), ("g/smu", "sum"), ("gg", "g")])
    def test_unknown(self, meaning: Callable[[str], list[str]], reference: str, nearest: str) -> None:
        """What does not exist is told the nearest that does."""
        with pytest.raises(DocumentError, match=nearest):
            meaning(reference)

    def test_inputs_of_a_used_graph_lead_outwards(self, meaning: Callable[[str], list[str]]) -> None:
        """Its input is what its user plugged in."""
        assert meaning("g/a") == ["x"]
