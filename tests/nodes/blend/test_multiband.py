"""Blending band by band."""

import numpy as np
from portraits import eyes_apart

from graphface.nodes.blend.multiband import multiband
from graphface.nodes.types import Image

SIZE = 128


def half() -> np.ndarray:
    """A mask whose right half is 1."""
    mask = np.zeros((SIZE, SIZE), np.float32)
    mask[:, SIZE // 2 :] = 1
    return mask


def blended(change: np.ndarray) -> np.ndarray:
    base = Image(np.full((SIZE, SIZE, 3), 0.5, np.float32))
    layer = base.with_pixels(base.pixels + change[..., None])
    return multiband(base, layer, half(), eyes_apart(80)).pixels[..., 0] - base.pixels[..., 0]


def test_tones_are_blended_softly():
    """A new tone rises over many pixels on both sides of the mask's edge."""
    across = blended(np.full((SIZE, SIZE), 0.2, np.float32))[SIZE // 2]
    assert ((across > 0.02) & (across < 0.18)).sum() > 10


def test_texture_is_blended_sharply():
    """A texture of single pixels ends within a few pixels of the edge."""
    board = np.float32(0.2) * ((np.indices((SIZE, SIZE)).sum(axis=0) % 2).astype(np.float32) - np.float32(0.5))
    contrast = np.abs(np.diff(blended(board)[SIZE // 2]))
    assert contrast[: SIZE // 2 - 5].max() < 0.02
    assert contrast[SIZE // 2 + 5 :].min() > 0.18
