"""Letters: one font, kept once read."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from PIL.ImageDraw import ImageDraw

PAPER, INK, FAINT = (246, 246, 244), (30, 30, 34), (150, 150, 154)
"""Colors of cards and diagrams."""


@cache
def font(size: int) -> Any:
    """Pillow's own font, which is there on every machine."""
    from PIL import ImageFont

    return ImageFont.load_default(max(7, size))


def write(pen: ImageDraw, at: tuple[float, float], text: str, size: int, *, width: float, color: Any = INK) -> None:
    """One line of text, shortened with dots to a width in pixels."""
    letters = font(size)
    if pen.textlength(text, letters) > width:
        while text and pen.textlength(text + "...", letters) > width:
            text = text[:-1]
        text += "..." if text else ""
    pen.text(at, text, color, letters)
