"""Differences in words."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from graphface.report.difference.compare import Comparison
from graphface.report.difference.tolerance import Tolerance
from graphface.report.difference.values import PartDifference
from graphface.report.difference.words import HEADER, cause, first_lines, measured, percent, place, rows, short, summary


@pytest.mark.parametrize(
    ("value", "said"),
    [(0.0, "0"), (0.123456, "0.123"), (12.0, "12"), (1e-7, "1.00e-07"), (99999.0, "100000"), (1e-4, "0.0001")],
)
def test_short(value: float, said: str) -> None:
    """Three digits."""
    assert short(value) == said


@pytest.mark.parametrize(
    ("share", "said"), [(0.0, "0.00%"), (1e-6, "<0.01%"), (0.004, "0.40%"), (0.9999, "99%"), (1.0, "100%")]
)
def test_percent(share: float, said: str) -> None:
    """What is not all is never 100 %, what is not nothing never 0 %."""
    assert percent(share) == said


def test_measured() -> None:
    """Size, share, and the box where not everything differs."""
    part = PartDifference(
        "", greatest=0.5, mean=0.1, span=2, share=0.25, position=(3, 4, 1), box=(1, 2, 3, 4), shape=(9, 9, 3)
    )
    assert measured(part) == "by up to 0.5 of a range of 2 (mean 0.1); 25% of pixels, within x 1..3, y 2..5"
    assert place(part) == "x 4, y 3, channel 1"
    assert "3 values are not finite on one side only" in measured(PartDifference("", non_finite=3, position=(0,)))


def test_sentences(compared: Callable[..., Comparison]) -> None:
    """The first node with what was changed, then a row for each, then how many."""
    found = compared(set={"s.by": 4}).differences()
    assert first_lines(found)[:2] == ["first difference: s (toy.scale)", "    parameter by changed from 3.0 to 4.0"]
    assert [len(row) for row in rows(found)] == [len(HEADER)] * 4
    assert cause(found.nodes[1]) == "inherited from s"
    assert summary(found) == "4 of 6 nodes differ; 2 have the same key: nothing to compare"


def test_below(compared: Callable[..., Comparison]) -> None:
    """What the tolerance let through is counted."""
    found = compared(set={"n.plus": 1e-3}).differences(Tolerance(0.5))
    assert summary(found).startswith("no node of 6 differs; 1 differ within the tolerance of 0.5 of the range")
    assert first_lines(found) == []
