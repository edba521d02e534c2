"""Differences in words."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from graphface.report.difference.compare import Comparison
from graphface.report.difference.values import PartDifference
from graphface.report.difference.words import HEADER, cause, in_full, measured, percent, place, row, short


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


def test_rows(compared: Callable[..., Comparison]) -> None:
    """A cell under each heading; what was changed there, or what the node inherits."""
    nodes = compared(set={"s.by": 4}).differences().nodes
    assert [len(row(node)) for node in nodes] == [len(HEADER)] * 4
    assert [cause(node) for node in nodes[:2]] == ["parameter by changed from 3.0 to 4.0", "inherited from s"]
    assert in_full(nodes[0])[:2] == ["s (toy.scale)", "    parameter by changed from 3.0 to 4.0"]
