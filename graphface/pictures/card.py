"""Numbers and texts as themselves, on a card."""

from __future__ import annotations

import textwrap

import numpy as np

from graphface.values.picture import Picture, View

SIZE = 256
"""Pixels of a card's side where the view does not say."""
_PAPER, _INK = (246, 246, 244), (30, 30, 34)


def draw_text(text: str, view: View) -> Picture:
    """A text, wrapped and as large as it fits."""
    from PIL import Image, ImageDraw, ImageFont

    side = min(view.size or SIZE, 2 * SIZE)
    card = Image.new("RGB", (side, side * 3 // 4), _PAPER)
    pen = ImageDraw.Draw(card)
    for size in (side // 6, side // 9, side // 12, side // 16, side // 22):
        font = ImageFont.load_default(max(size, 7))
        characters = max(4, int(side * 0.92 / max(pen.textlength("n", font), 1)))
        lines = [part for line in text.splitlines() or [""] for part in textwrap.wrap(line, characters) or [""]]
        wrapped = "\n".join(lines)
        box = pen.multiline_textbbox((0, 0), wrapped, font)
        if box[2] <= side * 0.94 and box[3] <= side * 0.7:
            break
    pen.multiline_text((side * 0.03, side * 0.03), wrapped, _INK, font)
    return Picture(np.asarray(card))
