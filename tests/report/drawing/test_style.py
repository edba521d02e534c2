"""The style sheet of a drawing."""

import re

from graphface.report.drawing.style import style


def test_scoped() -> None:
    """Every rule is for drawings alone, in light and dark."""
    rules = style([15, 30]).replace("@media (prefers-color-scheme: dark) {", "")
    for selectors in re.findall(r"([^{}]+)\{", rules):
        assert all(s.strip().startswith(".graphface-drawing ") for s in selectors.split(",")), selectors


def test_families() -> None:
    """Each hue has its colors twice: on light, and on dark."""
    assert style([15]).count(".hue-15 .stripe") == 2
