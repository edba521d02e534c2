"""What classifiers see: the features of pixels, the weights of a network."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphface.nodes.pictures.mosaic import mosaic, tile_view
from graphface.pictures.card import draw_text
from graphface.pictures.colors import grey_of, with_odd
from graphface.pictures.plots import draw_numbers
from graphface.values.picture import Picture, View

_MOST = 25


def draw_pixel_features(features: Any, view: View) -> Picture:
    """Every channel by itself: grey from its smallest to its largest value."""
    values = features.values
    if not values.size:
        return draw_text("no features", view)
    count = min(values.shape[2], _MOST)
    tile = tile_view(view, count)
    seen = tile.sampled(values)
    tiles = []
    for channel in range(count):
        pixels, _ = grey_of(seen[..., channel])
        shown = Picture(pixels, "", seen[..., channel], ("value",), (values.shape[0], values.shape[1]))
        tiles.append((str(channel), shown))
    more = f"; {values.shape[2] - count} more" if values.shape[2] > count else ""
    note = f"{values.shape[2]} channels, each from its smallest (black) to its largest value (white){more}"
    return mosaic(tiles, with_odd(note, values))


def draw_weights(weights: Any, view: View) -> Picture:
    """The root mean square of every layer."""
    layers = weights.arrays
    if not layers:
        return draw_text("no weights", view)
    sizes = [float(np.linalg.norm(values)) / max(1, values.size) ** 0.5 for values in layers.values()]
    total = sum(values.size for values in layers.values())
    drawn = draw_numbers(sizes, view, list(layers))
    return Picture(drawn.pixels, f"root mean square of each layer; {total} weights in {len(layers)} layers")
