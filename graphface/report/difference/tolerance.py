"""Which differences count as none."""

from __future__ import annotations

from dataclasses import dataclass

from graphface.report.difference.values import PartDifference

GOLDEN = 1e-5
"""Share of a value's range that is allowed against known-good values where nothing else is asked for.

Another processor, another number of threads or another build of BLAS adds up in another order: float32 sums then differ
by about 1e-6 of the range. One step of a 16-bit picture is 1.5e-5, one of an 8-bit picture 4e-3: a wrong result that
somebody could see is well above.
"""


@dataclass(frozen=True)
class Tolerance:
    """The greatest difference that counts as none: a share of the range of the first side's values, or an absolute one.

    What has no size (another type or shape, NaN on one side only) always counts.
    """

    share: float = 0.0
    absolute: float | None = None

    def allows(self, part: PartDifference) -> bool:
        if part.words or part.non_finite:
            return False
        return part.relative <= self.share if self.absolute is None else part.greatest <= self.absolute

    def __str__(self) -> str:
        return f"{self.share:g} of the range" if self.absolute is None else f"{self.absolute:g}"


EXACT = Tolerance()
