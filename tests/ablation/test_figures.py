"""Which metrics fit an output, and what they say of a result and the truth."""

from __future__ import annotations

import pytest

from graphface import UsageError, node
from graphface.ablation import ablate
from graphface.ablation.figures import measured, metrics_for

GRAPH = (
    "graphface: 1\ninputs: {x: float}\nnodes: {last: {use: toy.add, in: {a: x}, with: {plus: 3}}}\noutputs: {y: last}\n"
)


@node("metrics.apart")
def apart(result: float, truth: float) -> float:
    """How far apart two numbers are; lower is better."""
    return abs(result - truth)


@node("metrics.needs_more")
def needs_more(result: float, truth: float, third: float) -> float:
    """Cannot be measured with two values."""
    return 0.0


@pytest.fixture
def measuring(registry):
    registry.add(apart)
    registry.add(needs_more)
    return registry


class TestFigures:
    def test_figures_against_the_truth(self, measuring):
        """Each metric that fits is measured; one that needs a third value is not."""
        declared = measuring.operator("toy.add").output
        metrics = metrics_for(declared, measuring)
        assert [m.name for m in metrics] == ["apart"]
        done = ablate(
            GRAPH, ["last=add,subtract"], [{"x": 2.0}], truths=[4.0], metrics=metrics, loading={"registry": measuring}
        )
        assert [cell.figures["apart"] for cell in done.cells] == [1.0, 2.0]

    def test_a_metric_that_refuses_is_left_out(self, measuring):
        """A figure that cannot be had is absent, not zero."""

        @node("metrics.picky")
        def picky(result: float, truth: float) -> float:
            raise ValueError("never")

        measuring.add(picky)
        metrics = metrics_for(measuring.operator("toy.add").output, measuring)
        assert set(measured(metrics, 1.0, 2.0)) == {"apart"}

    def test_unknown(self, measuring):
        """A metric that is not there is told the nearest."""
        with pytest.raises(UsageError, match="apart"):
            metrics_for(measuring.operator("toy.add").output, measuring, ["aprt"])
