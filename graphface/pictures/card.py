"""Numbers and texts as themselves, on a card."""

from __future__ import annotations

import textwrap

import numpy as np

from graphface.pictures.text import INK, PAPER, font
from graphface.values.picture import Picture, View

SIZE = 256
"""Pixels of a card's side where the view does not say."""
_MOST = 4000
"""Characters of a text that are looked at; no card has room for more."""


def draw_text(text: str, view: View) -> Picture:
    """A text, wrapped and as large as it fits; what does not fit is cut off with dots."""
    from PIL import Image, ImageDraw

    side = max(16, min(view.size or SIZE, 2 * SIZE))
    card = Image.new("RGB", (side, side * 3 // 4), PAPER)
    pen = ImageDraw.Draw(card)
    margin, room = side // 20, side * 3 // 4 - 2 * (side // 20)
    for size in (side // 6, side // 9, side // 12, side // 16, side // 22):
        letters = font(size)
        lines = _wrapped(text[:_MOST], max(4, int((side - 2 * margin) / max(pen.textlength("n", letters), 1))))
        step = 1.25 * max(7, size)
        wide = max(pen.textlength(line, letters) for line in lines)
        whole = all(len(word) <= max(map(len, lines)) for word in text.split())
        if whole and wide <= side - 2 * margin and len(lines) * step <= room:
            break
    kept = lines[: max(1, int(room / step))]
    if len(kept) < len(lines):
        kept[-1] = kept[-1][:-3] + "..."
    for row, line in enumerate(kept):
        pen.text((margin, margin + row * step), line, INK, letters)
    return Picture(np.asarray(card))


def _wrapped(text: str, characters: int) -> list[str]:
    printable = "".join(c if c.isprintable() or c == "\n" else " " for c in text)
    return [part for line in printable.splitlines() or [""] for part in textwrap.wrap(line, characters) or [""]]
