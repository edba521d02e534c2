"""Textures: a face's colors in the model's own plane."""

from __future__ import annotations

import numpy as np

from graphface.nodes.pictures.photo import bytes_of
from graphface.nodes.types import Texture
from graphface.pictures.colors import with_odd
from graphface.values.picture import Picture, View


def draw_texture(texture: Texture, view: View) -> Picture:
    """The texture over grey where the photo does not show it."""
    seen, share = view.sampled(texture.image.pixels), view.sampled(texture.seen)
    cover = np.clip(np.nan_to_num(share), 0, 1)[..., None]
    pixels = np.rint(bytes_of(texture.image, seen) * cover + 128 * (1 - cover)).astype(np.uint8)
    data = np.concatenate([seen, share[..., None]], axis=2)
    note = f"grey: not seen in the photo; {np.nanmean(share):.0%} is seen" if share.size else ""
    full = (texture.image.height, texture.image.width)
    return Picture(pixels, with_odd(note, data), data, ("red", "green", "blue", "seen"), full)
