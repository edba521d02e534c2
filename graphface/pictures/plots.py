"""Numbers in a row: a list of a few as bars, an array as a curve."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from graphface.pictures.card import SIZE
from graphface.pictures.colors import NON_FINITE
from graphface.pictures.text import FAINT, INK, PAPER, write
from graphface.values.picture import Picture, View

if TYPE_CHECKING:
    from PIL.ImageDraw import ImageDraw

_ROW = 11
"""Pixels of a bar's row, at the least."""
_CURVES = ((52, 101, 164), (204, 80, 40), (78, 154, 6), (117, 80, 123))


def draw_numbers(values: Sequence[float], view: View, labels: Sequence[str] = ()) -> Picture:
    """A few numbers as bars from 0, each with its value, and its label or place in the row; many as a curve."""
    from PIL import Image, ImageDraw

    side = max(64, min(view.size or SIZE, 2 * SIZE))
    if len(values) * _ROW + 8 > side:
        return draw_curve(np.array(values), view)
    row = min(side // 12, (side - 8) // max(1, len(values))) if side >= 12 * _ROW else _ROW
    wide = max(64, side)
    card = Image.new("RGB", (wide, row * len(values) + 8), PAPER)
    pen = ImageDraw.Draw(card)
    finite = [value for value in values if np.isfinite(value)]
    low, high = min([0.0, *finite]), max([0.0, *finite])
    left, length = wide * 0.3, wide * 0.42
    zero = left + length * (-low / ((high - low) or 1))
    for index, value in enumerate(values):
        top = 4 + index * row
        write(pen, (4, top), labels[index] if labels else str(index), row * 3 // 4, width=left - 8)
        if np.isfinite(value):
            end = left + length * (value - low) / ((high - low) or 1)
            pen.rectangle((min(zero, end), top + 1, max(zero, end), top + row - 3), _CURVES[0])
        else:
            pen.rectangle((left, top + 1, left + length, top + row - 3), NON_FINITE)
        write(pen, (left + length + 6, top), f"{value:.4g}", row * 3 // 4, width=wide - left - length - 8)
    pen.line((zero, 2, zero, card.height - 3), FAINT)
    return Picture(np.asarray(card), "bars from 0")


def draw_curve(values: NDArray[Any], view: View) -> Picture:
    """An array (n,), or (n, c) with a curve for each column, over the index.

    Where more values than pixels lie side by side, the smallest and the largest of them are drawn.
    """
    from PIL import Image, ImageDraw

    wide = max(64, min(view.size or SIZE, 2 * SIZE))
    high, edge, size = wide * 5 // 8, max(4, wide // 40), max(8, wide // 24)
    card = Image.new("RGB", (wide, high), PAPER)
    pen = ImageDraw.Draw(card)
    columns = values.reshape(len(values), -1).astype(np.float64)[:, : len(_CURVES)]
    finite = columns[np.isfinite(columns)]
    low, most = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
    reach = (most - low) or 1.0
    top, bottom = edge + 1.4 * size, high - edge - 1.4 * size

    def y_of(value: float) -> float:
        return bottom - (bottom - top) * (value - low) / reach if most > low else (top + bottom) / 2

    if low <= 0 <= most:
        pen.line((edge, y_of(0), wide - edge, y_of(0)), FAINT)
    for column, color in zip(columns.T, _CURVES, strict=False):
        _curve(pen, column, (edge, wide - edge, top, bottom), y_of, color)
    write(pen, (edge, edge // 2), f"{most:.4g}", size, width=wide / 2)
    write(pen, (edge, bottom + edge // 2), f"{low:.4g}", size, width=wide / 2)
    last = f"{len(values) - 1}"
    write(pen, (wide - edge - 0.62 * size * len(last), bottom + edge // 2), last, size, width=wide, color=INK)
    odd = int((~np.isfinite(values)).sum()) if values.dtype.kind == "f" else 0
    names = "" if columns.shape[1] == 1 else "; blue, red, green, violet: columns 0, 1, 2, 3"
    return Picture(
        np.asarray(card),
        f"{len(values)} values over their index, from {low:.4g} to {most:.4g}{names}"
        + (f"; magenta: not finite ({odd})" if odd else ""),
    )


def _curve(
    pen: ImageDraw, values: NDArray[np.float64], frame: tuple[float, float, float, float], y_of: Any, color: Any
) -> None:
    """One curve: a line through the values, or from the smallest to the largest of those at one pixel."""
    left, right, top, bottom = frame
    pixels = max(2, int(right - left))
    if len(values) <= pixels:
        x = np.linspace(left, right, len(values)) if len(values) > 1 else np.array([left])
        groups = [values[i : i + 1] for i in range(len(values))]
    else:
        x = left + np.arange(float(pixels))
        groups = np.array_split(values, pixels)
    previous: tuple[float, float] | None = None
    for at, group in zip(x, groups, strict=True):
        finite = group[np.isfinite(group)]
        if len(finite) < len(group):
            pen.line((at, top, at, bottom), NON_FINITE)
        if not len(finite):
            previous = None
            continue
        first, last = y_of(float(finite.min())), y_of(float(finite.max()))
        if previous is not None:
            pen.line((*previous, at, (first + last) / 2), color, 2)
        pen.line((at, first, at, last), color, 2)
        if len(values) == 1:
            pen.ellipse((at - 3, first - 3, at + 3, first + 3), color)
        previous = (at, (first + last) / 2)
