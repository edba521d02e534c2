"""Text measured without its font, and cut to fit."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.report.drawing.text_width import fitted, text_width, wrapped


class TestFitted:
    @given(st.text(), st.floats(0, 200), st.booleans())
    def test_never_wider(self, text: str, room: float, bold: bool) -> None:
        """What is left of any text is no wider than the room, and one line."""
        cut = fitted(text, room, 11, bold=bold)
        assert text_width(cut, 11, bold=bold) <= room + 1e-6
        assert "\n" not in cut

    def test_whole(self) -> None:
        """A text that fits exactly stays whole."""
        assert fitted("head_surface", text_width("head_surface", 13), 13) == "head_surface"

    def test_ellipsis(self) -> None:
        """A text that does not says that it goes on."""
        assert fitted("head_surface", 60, 13).endswith("…")


def test_wrapped() -> None:
    """Broken at spaces, the last line cut."""
    lines = wrapped("the scene has no environment light and asks for no highlights", 120, 10.5, 2)
    assert len(lines) == 2
    assert lines[0].startswith("the scene")
    assert lines[1].endswith("…")
    assert wrapped("", 100, 10, 2) == []


@pytest.mark.parametrize("font", ["DejaVuSans.ttf", "LiberationSans-Regular.ttf", "Arial.ttf"])
def test_wide_enough(font: str) -> None:
    """No common font is wider than the table says."""
    from PIL import ImageFont

    try:
        face = ImageFont.truetype(font, 1000)
    except OSError:
        pytest.skip(f"{font} is not installed")
    for text in ("head_surface", "render.screen_space", "Segmentation | None", "WIDE (100 %)"):
        assert face.getlength(text) <= text_width(text, 1000) * 1.01
