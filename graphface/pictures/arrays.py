"""Arrays without a meaning of their own."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.pictures.card import draw_text
from graphface.pictures.colors import grey_of
from graphface.pictures.grid import draw_grid
from graphface.pictures.plots import draw_curve
from graphface.values.frozen import describe
from graphface.values.picture import Picture, View

_THIN = 8
"""An array at least so many times as high as it is wide, and of up to four columns, is a table, drawn as curves."""


def draw_array(array: NDArray[Any], view: View) -> Picture:
    """An array: a number, a curve, a picture, or pictures side by side; in words where it is none of these."""
    if array.dtype.kind == "c":
        array = np.abs(array)
    if array.dtype.kind not in "fiub" or not array.size:
        return draw_text(describe(array) if array.size else f"empty: {describe(array)}", view)
    if array.ndim == 0:
        return draw_text(f"{array[()]}", view)
    if array.ndim == 1 or (array.ndim == 2 and array.shape[1] <= 4 and array.shape[0] >= _THIN * array.shape[1]):
        return draw_curve(array, view)
    if array.ndim == 2 or (array.ndim == 3 and array.shape[2] <= 4):
        return _picture(array, view)
    if array.ndim == 3 and array.shape[0] <= array.shape[2]:
        return _layers(array, view)
    if array.ndim == 3:
        return _picture(array, view)
    return _layers(array.reshape(-1, *array.shape[-2:]), view)


def _picture(array: NDArray[Any], view: View) -> Picture:
    """H x W and H x W x C as grey, three channels as color; of more channels the mean."""
    seen = view.sampled(array)
    full = (array.shape[0], array.shape[1])
    channels = tuple(str(c) for c in range(seen.shape[2])) if seen.ndim == 3 else ()
    if seen.dtype == np.uint8 and seen.ndim == 3 and seen.shape[2] == 3:
        return Picture(np.ascontiguousarray(seen), "red, green and blue are channels 0, 1 and 2", seen, channels, full)
    if seen.ndim == 2 or seen.shape[2] == 3:
        pixels, note = grey_of(seen)
        note = f"red, green and blue are channels 0, 1 and 2; {note}" if seen.ndim == 3 else note
    else:
        pixels, note = grey_of(seen.astype(np.float32).mean(axis=2))
        note = f"mean of {seen.shape[2]} channels; {note}"
    return Picture(pixels, note, seen, channels, full)


def _layers(array: NDArray[Any], view: View) -> Picture:
    """N x H x W as pictures side by side, all of one scale."""
    seen = [view.sampled(layer) for layer in array[:36]]
    joined, note = grey_of(np.stack(seen).reshape(-1, seen[0].shape[1]))
    tiles = joined.reshape(len(seen), *seen[0].shape, 3)
    cells = [(str(i), _shown(tile)) for i, tile in enumerate(tiles)]
    return Picture(draw_grid(cells, view).pixels, f"{len(array)} layers, {note}")


def _shown(tile: NDArray[np.uint8]) -> Any:
    return lambda view: Picture(view.sampled(tile))
