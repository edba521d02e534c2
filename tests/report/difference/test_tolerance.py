"""Which differences count as none."""

import math

import pytest

from graphface.report.difference.tolerance import EXACT, GOLDEN, Tolerance
from graphface.report.difference.values import PartDifference

HALF = PartDifference("", greatest=0.5, span=2.0)


@pytest.mark.parametrize(
    ("tolerance", "allowed"),
    [(EXACT, False), (Tolerance(0.25), True), (Tolerance(0.2499), False), (Tolerance(absolute=0.5), True),
     (Tolerance(1.0, absolute=0.4), False)],
)  # fmt: skip
def test_sizes(tolerance: Tolerance, allowed: bool) -> None:
    """A share of the range, or an absolute size instead; what is as large as it is allowed."""
    assert tolerance.allows(HALF) is allowed


@pytest.mark.parametrize("part", [PartDifference("", "shape"), PartDifference("", non_finite=1)])
def test_without_a_size(part: PartDifference) -> None:
    """Another shape, or NaN on one side only, is never allowed."""
    assert not Tolerance(math.inf).allows(part)
    assert not Tolerance(absolute=math.inf).allows(part)


def test_golden_lies_between_rounding_and_what_can_be_seen() -> None:
    """Above float32 sums in another order, below one step of a 16-bit picture."""
    assert 1e-6 < GOLDEN < 1 / 65535
