"""What relighting computes once: samples, surroundings, shadow maps."""

from __future__ import annotations

import numpy as np

from graphface.nodes.pictures.masks import draw_mask
from graphface.nodes.pictures.mosaic import mosaic, tile_view
from graphface.nodes.types import Samples, Scene, Shadows, Surroundings
from graphface.pictures.card import draw_text
from graphface.pictures.colors import as_bytes, with_odd
from graphface.values.picture import Picture, View

_OFF = (28, 32, 52)
"""Where there is no sample."""


def draw_samples(samples: Samples, view: View) -> Picture:
    """The photo's own shading at every sample, on the grid that the samples lie on."""
    height, width = samples.grid
    if not height or not width:
        return draw_text("no samples", view)
    index = np.full(height * width, -1, np.intp)
    index[samples.cells] = np.arange(len(samples.cells))
    seen = view.sampled(index.reshape(height, width))
    there = seen >= 0
    columns = [
        samples.before.reshape(len(samples.cells), -1),
        samples.normals,
        samples.points,
        samples.weights[:, None],
    ]
    values = np.concatenate(columns, axis=1).astype(np.float32)
    data = np.full((*seen.shape, values.shape[1]), np.nan, np.float32)
    data[there] = values[seen[there]]
    before = columns[0].shape[1]
    shown = data[..., 0] if before == 1 else data[..., :before]
    pixels = as_bytes(np.nan_to_num(shown))
    pixels[~there] = _OFF
    note = f"{len(samples.cells)} samples; shading before, black is 0, white 1; dark blue: none"
    names = ("shading",) if before == 1 else ("shading red", "shading green", "shading blue")
    places = ("normal x", "normal y", "normal z", "x", "y", "z", "weight")
    return Picture(pixels, with_odd(note, values), data, (*names, *places), (height, width))


def draw_surroundings(surroundings: Surroundings, view: View) -> Picture:
    """The weight of the face, with a frame around the blocks that a shading is taken from."""
    picture = draw_mask(surroundings.weight, view)
    pixels = picture.pixels.copy()
    ratio = pixels.shape[0] / max(1, surroundings.weight.shape[0])
    top, bottom, left, right = (round(edge * surroundings.cell * ratio) for edge in surroundings.window)
    if bottom > top and right > left:
        bottom, right = min(bottom, pixels.shape[0]) - 1, min(right, pixels.shape[1]) - 1
        pixels[[top, bottom], left : right + 1] = pixels[top : bottom + 1, [left, right]] = (250, 170, 40)
    note = f"{picture.note}; orange: the face, in blocks of {surroundings.cell} px"
    return Picture(pixels, note, picture.data, picture.channels, picture.full)


def draw_shadows(shadows: Shadows, view: View) -> Picture:
    """One map for each light that casts a shadow."""
    if not len(shadows.visible) or not shadows.visible[0].size:
        return draw_text("no light casts a shadow that could be seen", view)
    tile = tile_view(view, len(shadows.visible))
    scene = view.above(Scene)
    tiles = []
    for number, visible in zip(shadows.lights, shadows.visible, strict=True):
        seen = tile.sampled(visible)
        kind = f": {scene.lights[number].type}" if scene is not None and number < len(scene.lights) else ""
        shown = Picture(as_bytes(seen), "", seen, ("visible",), (visible.shape[0], visible.shape[1]))
        tiles.append((f"light {number + 1}{kind}", shown))
    return mosaic(tiles, with_odd("share of each light that arrives: black is 0, white 1", shadows.visible))
