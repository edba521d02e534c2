"""Colors of families."""

import re

import pytest

from graphface.report.drawing.palette import Theme, family_color, family_tint, heat_color, hue


def test_stable() -> None:
    """A family's hue never changes: it is a function of its name."""
    assert hue("render") == hue("render")
    assert hue("render") != hue("masks")


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_written_as_hex(theme: Theme) -> None:
    colors = [family_color(hue("render"), theme), family_tint(hue("render"), theme), heat_color(-1), heat_color(2)]
    assert all(re.fullmatch("#[0-9a-f]{6}", color) for color in colors)
