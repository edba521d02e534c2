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
_LEAST = 48
"""Pixels of a cell's side, at the least: of a small picture some cells are left out."""
Cell = tuple[str, Callable[[View], Picture]]


def draw_grid(cells: Sequence[Cell], view: View, *, columns: int | None = None) -> Picture:
    """Cells in rows, of the picture's `size` together.

    Args:
        cells: label and what draws it at the size that it is given.
        columns: as many as make the whole about square, by default.
    """
    from PIL import Image, ImageDraw

    size = max(_LEAST, view.size or SIZE)
    widest = max(1, size // _LEAST)
    room = min(MOST, widest * widest)
    left_out = max(0, len(cells) - room)
    cells = cells[:room]
    columns = min(columns or math.ceil(math.sqrt(len(cells))), widest)
    count = -(-len(cells) // columns)
    letters = max(7, min(14, size // columns // 10))
    caption = letters * 3 // 2
    side = max(8, min(size // columns, (size - caption * bool(left_out)) // count - caption - 2) - 2)
    drawn = [(label, _fitted(draw(replace(view, size=side)), side)) for label, draw in cells]
    rows = [drawn[start : start + columns] for start in range(0, len(drawn), columns)]
    heights = [caption + max(tile.shape[0] for _, tile in row) + 2 for row in rows]
    width = columns * (side + 2)
    sheet = Image.new("RGB", (width, sum(heights) + caption * bool(left_out)), PAPER)
    pen = ImageDraw.Draw(sheet)
    top = 0
    for row, height in zip(rows, heights, strict=True):
        for column, (label, tile) in enumerate(row):
            left = column * (side + 2)
            write(pen, (left + 3, top + 1), label, letters, width=side - 4, color=INK)
            sheet.paste(Image.fromarray(tile), (left + (side - tile.shape[1]) // 2 + 1, top + caption))
        top += height
    if left_out:
        write(pen, (3, top), f"and {left_out} more", letters, width=side, color=FAINT)
    return Picture(np.asarray(sheet), f"{len(cells) + left_out} parts" if len(cells) != 1 else "one part")


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
