"""Cards with text."""

import numpy as np
import pytest

from graphface.pictures.card import draw_text
from graphface.values.picture import View


@pytest.mark.parametrize("text", ["7", "a few words", "long " * 900, "x" * 400, "a\n\nb", "\x00\x07"])
def test_text_stays_inside(text: str) -> None:
    """Nothing is written on the card's edge, however long the text is."""
    pixels = draw_text(text, View(120)).pixels
    assert pixels.shape == (90, 120, 3)
    edges = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    assert (edges > 240).all()


def test_short_text_is_large() -> None:
    """Fewer words are written larger."""
    few, many = draw_text("7", View(200)).pixels, draw_text("word " * 40, View(200)).pixels
    heights = []
    for pixels in (few, many):
        inked = (pixels < 128).any(axis=(1, 2))
        first = int(np.flatnonzero(inked)[0])
        heights.append(int(np.argmin(inked[first:])))
    assert heights[0] > heights[1]
