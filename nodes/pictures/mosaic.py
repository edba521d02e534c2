"""Maps side by side, their values with them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from graphface.pictures.text import font
from graphface.values.picture import Picture, View


def tile_view(view: View, count: int, columns: int | None = None) -> View:
    """The view for each of `count` maps that are to be put together."""
    if view.size is None:
        return view
    return replace(view, size=max(16, view.size // _columns(count, columns)))


def mosaic(tiles: Sequence[tuple[str, Picture]], note: str, *, columns: int | None = None) -> Picture:
    """Pictures of one size in rows, each with its label written into it, and their data in the same places.

    Where one has channels and another has not, the single one is repeated. Places that are left over hold NaN.
    """
    pixels = [_labelled(picture.pixels, label) for label, picture in tiles]
    most = max(_depth(picture) for _, picture in tiles)
    data = [_deep(picture, most) for _, picture in tiles]
    columns = _columns(len(tiles), columns)
    channels = next(picture.channels for _, picture in tiles if _depth(picture) == most)
    height, width = next(p.full or p.pixels.shape[:2] for _, p in tiles)
    full = (height * -(-len(tiles) // columns), width * columns)
    return Picture(_joined(pixels, columns, 24), note, _joined(data, columns, np.nan), channels, full)


def _columns(count: int, columns: int | None) -> int:
    return columns or max(1, math.ceil(math.sqrt(count)))


def _depth(picture: Picture) -> int:
    assert picture.data is not None
    return 1 if picture.data.ndim == 2 else picture.data.shape[2]


def _deep(picture: Picture, channels: int) -> np.ndarray:
    assert picture.data is not None
    data = picture.data if picture.data.ndim == 3 else picture.data[..., None]
    return np.repeat(data, channels, axis=2) if data.shape[2] != channels else data


def _joined(tiles: Sequence[np.ndarray], columns: int, rest: float) -> np.ndarray:
    missing = -len(tiles) % columns
    filled = [*tiles, *[np.full_like(tiles[0], rest)] * missing]
    rows = [np.concatenate(filled[start : start + columns], axis=1) for start in range(0, len(filled), columns)]
    return np.concatenate(rows, axis=0)


def _labelled(pixels: np.ndarray, label: str) -> np.ndarray:
    """The label in the upper left corner, where the picture is large enough to have room for it."""
    size = max(9, min(24, pixels.shape[1] // 20))
    if not label or min(pixels.shape[:2]) < 3 * size:
        return pixels
    from PIL import Image as Pillow
    from PIL import ImageDraw

    canvas = Pillow.fromarray(pixels)
    letters = font(size)
    ImageDraw.Draw(canvas).text((4, 2), label, (255, 255, 255), letters, stroke_width=2, stroke_fill=(0, 0, 0))
    return np.asarray(canvas)
