"""The table of an ablation: CSV in full, for people rounded."""

from __future__ import annotations

import csv
import io
from typing import Annotated

import pytest

from graphface import Figure, Registry, node
from graphface.ablation import ablate
from graphface.ablation.figures import metrics_for
from graphface.ablation.running import Ablation
from graphface.ablation.table import as_csv, as_markdown, rows, shown_columns


@node("metrics.apart")
def apart(result: float, truth: float) -> Annotated[float, Figure("lower", unit="dB")]:
    """How far apart two numbers are."""
    return abs(result - truth)


@pytest.fixture
def measured(registry: Registry) -> Ablation:
    """Two variants, 1 and 2 from the truth."""
    registry.add(apart)
    last = "{use: toy.add, in: {a: x}, with: {plus: 3}}"
    text = f"graphface: 1\ninputs: {{x: float}}\nnodes: {{last: {last}}}\noutputs: {{y: last}}\n"
    metrics = metrics_for(registry.operator("toy.add").output, registry)
    loading = {"registry": registry}
    return ablate(text, ["last=add,subtract"], [{"x": 2.0}], truths=[4.0], metrics=metrics, loading=loading)


class TestFiles:
    def test_csv(self, numbers: Ablation) -> None:
        """A line for each variant, under one header."""
        lines = list(csv.DictReader(io.StringIO(as_csv(numbers))))
        assert [line["variant"] for line in lines] == ["toy.add", "toy.subtract"]
        assert lines[1]["shared nodes"] == "2 of 3"

    def test_times(self, numbers: Ablation) -> None:
        """In milliseconds, the mean over cases."""
        assert [row["alone ms"] for row in rows(numbers)] == [1e3 * cell.alone for cell in numbers.cells]

    def test_markdown(self, measured: Ablation) -> None:
        """A row for each variant, the best in bold, and the sentence on sharing under them."""
        text = as_markdown(measured)
        assert text.startswith("| variant | apart | alone |")
        assert "| toy.add | **1.0 dB** |" in text
        assert text.endswith(f"{measured.sharing}.\n")

    def test_bars_in_names(self, registry: Registry) -> None:
        """A name cannot break the table."""
        ranged = "{use: toy.ranged, in: {a: b}, with: {must: 1}}"
        text = f"graphface: 1\nnodes: {{a: {ranged}, b: {{use: toy.number}}}}\noutputs: {{y: a}}\n"
        done = ablate(text, ["a.mode=x|y,z"], [{}], loading={"registry": registry})
        assert "a.mode=x\\|y" in as_markdown(done)


class TestForPeople:
    def test_best(self, measured: Ablation) -> None:
        """The metric says what is better and in which unit."""
        column = next(c for c in shown_columns(measured) if c.title == "apart")
        assert (column.texts, column.best, column.meaning) == (["1.0 dB", "2.0 dB"], {0}, "lower is better")

    def test_time_spent_has_no_best(self, numbers: Ablation) -> None:
        """It depends on the order of the variants."""
        assert next(c for c in shown_columns(numbers) if c.title == "spent here").best == frozenset()

    def test_failures(self, registry: Registry) -> None:
        """Counted where there are any."""
        text = "graphface: 1\ninputs: {x: float}\nnodes: {last: {use: toy.add, in: {a: x}}}\noutputs: {y: last}\n"
        loading = {"registry": registry}
        assert "failed" not in [
            c.title for c in shown_columns(ablate(text, ["last=add"], [{"x": 1.0}], loading=loading))
        ]
        done = ablate(text, ["last=add,fail"], [{"x": 1.0}], loading=loading)
        assert next(c for c in shown_columns(done) if c.title == "failed").texts == ["0", "1"]
