"""Several pictures in one, each under its label."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from graphface.pictures.text import FAINT, INK, PAPER, write
from graphface.values.picture import Picture, View

SIZE = 768
"""Pixels of a grid's longer side where the view does not say."""
MOST = 36
"""Cells of a grid; of more, the last says how many are left out."""
Cell = tuple[str, Callable[[View], Picture]]


def draw_grid(cells: Sequence[Cell], view: View, *, columns: int | None = None) -> Picture:
    """Cells in rows, of the picture's `size` together.

    Args:
        cells: label and what draws it at the size that it is given.
        columns: as many as make the whole about square, by default.
    """
    from PIL import Image, ImageDraw

    left_out = max(0, len(cells) - MOST)
    cells = cells[: MOST - 1] if left_out else cells
    count = len(cells) + bool(left_out)
    columns = columns or max(1, math.ceil(math.sqrt(count)))
    size = max(32 * columns, view.size or SIZE)
    side = size // columns - 2
    letters = max(8, min(14, side // 10))
    drawn = [(label, _fitted(draw(replace(view, size=side)), side)) for label, draw in cells]
    rows = [drawn[start : start + columns] for start in range(0, len(drawn), columns)]
    caption = letters * 3 // 2
    heights = [caption + max(tile.shape[0] for _, tile in row) + 2 for row in rows]
    sheet = Image.new("RGB", (columns * (side + 2), sum(heights) + caption * bool(left_out)), PAPER)
    pen = ImageDraw.Draw(sheet)
    top = 0
    for row, height in zip(rows, heights, strict=True):
        for column, (label, tile) in enumerate(row):
            left = column * (side + 2)
            write(pen, (left + 3, top + 1), label, letters, width=side - 4, color=INK)
            sheet.paste(Image.fromarray(tile), (left + (side - tile.shape[1]) // 2 + 1, top + caption))
        top += height
    if left_out:
        write(pen, (3, top), f"and {left_out + 1} more", letters, width=side, color=FAINT)
    return Picture(np.asarray(sheet), _note(cells))


def _fitted(picture: Picture, side: int) -> np.ndarray:
    """A picture no larger than a cell; a small one enlarged by whole pixels."""
    from PIL import Image

    pixels = picture.pixels
    longest = max(pixels.shape[:2])
    if longest > side:
        ratio = side / longest
        shape = (max(1, round(pixels.shape[1] * ratio)), max(1, round(pixels.shape[0] * ratio)))
        return np.asarray(Image.fromarray(pixels).resize(shape, Image.Resampling.BOX))
    times = side // longest
    return pixels if times < 2 else np.repeat(np.repeat(pixels, times, axis=0), times, axis=1)


def _note(cells: Sequence[Cell]) -> str:
    return f"{len(cells)} parts" if len(cells) != 1 else "one part"
