"""Masks, alone and in groups, as colors over the photo."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from itertools import pairwise
from typing import Any

import numpy as np

from graphface.nodes.pictures.photo import Pixels, backdrop, darkened, photo_for, tinted
from graphface.nodes.types import Features, FloatArray, HeadMasks, Mask, Regions, Segmentation
from graphface.pictures.colors import as_bytes, mark_odd, with_odd
from graphface.pictures.text import font
from graphface.values.picture import Picture, View

GREEN, RED, BLUE, ORANGE = (70, 220, 120), (235, 70, 60), (70, 130, 245), (250, 170, 40)
_PALETTE = {
    "blue": BLUE,
    "orange": ORANGE,
    "green": GREEN,
    "red": RED,
    "violet": (175, 95, 230),
    "yellow": (245, 235, 70),
    "cyan": (70, 225, 235),
    "pink": (250, 130, 190),
    "white": (250, 250, 250),
}
_LETTERS_FROM = 160
"""Pixels of a picture's shorter side from which the parts are named in it."""


def draw_mask(mask: Mask, view: View) -> Picture:
    """Green over the photo; without a photo black to white."""
    seen = view.sampled(mask)
    full = (mask.shape[0], mask.shape[1])
    photo = photo_for(view, full, seen.shape)
    if photo is None:
        pixels, note = as_bytes(seen), "black is 0, white 1"
    else:
        pixels = tinted(darkened(photo), [seen], [GREEN])
        mark_odd(pixels, seen)
        note = "green is 1, the photo alone 0"
    outside = seen.size > 0 and not (seen.min() >= 0 and seen.max() <= 1)
    beyond = float(((seen < 0) | (seen > 1)).mean()) if outside else 0.0
    note += f"; {beyond:.1%} of the pixels lie outside 0 to 1" if beyond > 0 else ""
    covered = f"; covers {np.nanmean(seen):.1%}" if seen.size and np.isfinite(seen).any() else ""
    return Picture(pixels, with_odd(note + covered, seen), seen, ("mask",), full)


def draw_segmentation(labels: Segmentation, view: View) -> Picture:
    """Face green, hair red, background as it is."""
    return _parts(_maps(labels), view, {"face": ("green", GREEN), "hair": ("red", RED)}, rest="background")


def draw_head_masks(masks: HeadMasks, view: View) -> Picture:
    """The widest mask under the narrower ones."""
    colors = {"aggressive": ("blue", BLUE), "normal": ("green", GREEN), "conservative": ("orange", ORANGE)}
    return _parts(_maps(masks), view, colors, nested=True)


def draw_features(features: Features, view: View) -> Picture:
    """Every part in a color of its own."""
    return _parts(_maps(features), view, _colors(Features))


def draw_regions(regions: Regions, view: View) -> Picture:
    """Every region in a color of its own."""
    return _parts(_maps(regions), view, _colors(Regions))


def _colors(kind: Any) -> dict[str, tuple[str, tuple[int, int, int]]]:
    return {field.name: item for field, item in zip(fields(kind), _PALETTE.items(), strict=False)}


def _maps(value: Any) -> dict[str, FloatArray]:
    return {field.name: getattr(value, field.name) for field in fields(value)}


def _parts(
    maps: Mapping[str, FloatArray],
    view: View,
    colors: Mapping[str, tuple[str, tuple[int, int, int]]],
    *,
    rest: str = "",
    nested: bool = False,
) -> Picture:
    """Masks of one size as colors over the photo, the later ones above.

    Args:
        colors: of each part that gets one, with the color's name. rest: the part that stays as the photo is.
        nested: every part lies within the one before it, and takes its place.
    """
    seen = {name: view.sampled(values) for name, values in maps.items()}
    first = next(iter(maps.values()))
    full, shown = (first.shape[0], first.shape[1]), next(iter(seen.values())).shape
    weights = [seen[name] for name in colors]
    if nested:
        weights = [outer * (1 - inner) for outer, inner in pairwise(weights)] + weights[-1:]
    pixels = tinted(backdrop(view, full, shown), weights, [color for _, color in colors.values()])
    data = np.stack(list(seen.values()), axis=2)
    mark_odd(pixels, data)
    if view.size is None and min(shown) >= _LETTERS_FROM:  # a page shows the note beside the picture, a file does not
        pixels = _with_legend(pixels, colors)
    note = ", ".join(f"{name.replace('_', ' ')} {word}" for name, (word, _) in colors.items())
    note += f"; {rest} is left as it is" if rest else ""
    return Picture(pixels, with_odd(note, data), data, tuple(seen), full)


def _with_legend(pixels: Pixels, colors: Mapping[str, tuple[str, tuple[int, int, int]]]) -> Pixels:
    """The name of every part in its color, in the upper left corner."""
    from PIL import Image as Pillow
    from PIL import ImageDraw

    canvas = Pillow.fromarray(pixels)
    pen = ImageDraw.Draw(canvas)
    size = max(9, min(28, max(pixels.shape[:2]) // 36))
    for row, (name, (_, color)) in enumerate(colors.items()):
        at = (size // 2, size // 3 + row * size * 5 // 4)
        pen.text(at, name.replace("_", " "), color, font(size), stroke_width=max(1, size // 8), stroke_fill=(0, 0, 0))
    return np.asarray(canvas)
