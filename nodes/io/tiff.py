"""The samples of TIFF files as they are stored: every layout of strips and tiles, planes and pixels, of 8 to 64 bits.

Pillow and OpenCV decode some of these layouts into scrambled pictures without an error. Read here: without compression
or deflated; whole numbers of 8, 16 or 32 bits and floating-point ones of 16, 32 or 64; grey or RGB with any further
samples; all three predictors; either byte order. TIFF 6.0, its Technical Note 2, and Technical Note 3 (floating-point
predictor), Adobe.
"""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

WIDTH, HEIGHT, BITS, COMPRESSION, PHOTOMETRIC, FILL_ORDER = 256, 257, 258, 259, 262, 266
STRIPS, SAMPLES, ROWS, STRIP_SIZES, PLANAR, PREDICTOR = 273, 277, 278, 279, 284, 317
TILE_WIDTH, TILE_HEIGHT, TILES, TILE_SIZES, EXTRA, FORMAT = 322, 323, 324, 325, 338, 339

_DEFLATED = (8, 32946)
_KINDS = {(1, 8): "u1", (1, 16): "u2", (1, 32): "u4", (3, 16): "f2", (3, 32): "f4", (3, 64): "f8"}
_MOST_SAMPLES = 8

Tags = Mapping[int, Any]


def can_be_read(tags: Tags) -> bool:
    """Whether `read_samples` reads a file with these tags."""
    return (
        _one(tags, COMPRESSION, 1) in (1, *_DEFLATED)
        and _one(tags, PHOTOMETRIC, 1) in (0, 1, 2)
        and _one(tags, FILL_ORDER, 1) == 1
        and _one(tags, PREDICTOR, 1) in (1, 2, 3)
        and colors(tags) <= _one(tags, SAMPLES, 1) <= _MOST_SAMPLES
        and _kind(tags) is not None
    )


def is_planar(tags: Tags) -> bool:
    """Whether the samples of a pixel lie apart."""
    return bool(_one(tags, PLANAR, 1) == 2 and _one(tags, SAMPLES, 1) > 1)


def is_signed(tags: Tags) -> bool:
    """Whether samples are of a kind that pictures do not have: signed or complex numbers, or several kinds at once."""
    return any(kind not in (1, 3, 4) for kind in _all(tags, FORMAT, 1)) or len(set(_all(tags, FORMAT, 1))) > 1


def colors(tags: Tags) -> int:
    """Samples of a pixel that are its color: 1 or 3 (4 where they are inks)."""
    return {2: 3, 5: 4, 6: 3, 8: 3}.get(_one(tags, PHOTOMETRIC, 1), 1)


def read_samples(content: bytes, tags: Tags) -> NDArray[Any]:
    """The samples (H, W, n) of a file whose tags `can_be_read`, in their own dtype and the machine's byte order.

    Raises:
        ValueError, zlib.error: it is damaged or cut off.
    """
    width, height, count = _one(tags, WIDTH, 0), _one(tags, HEIGHT, 0), _one(tags, SAMPLES, 1)
    stored = np.dtype(f"{'<' if content[:2] == b'II' else '>'}{_kind(tags)}")
    each = 1 if is_planar(tags) else count
    tiled = TILES in tags
    block = (_one(tags, TILE_HEIGHT, 0), _one(tags, TILE_WIDTH, 0))
    if not tiled:
        block = (min(_one(tags, ROWS, height), height), width)
    if min(*block, width, height) < 1:
        raise ValueError(f"blocks of {block[1]} x {block[0]} pixels")
    across, down = -(-width // block[1]), -(-height // block[0])
    places = _all(tags, TILES if tiled else STRIPS, ())
    sizes = _all(tags, TILE_SIZES if tiled else STRIP_SIZES, ())
    if not len(places) == len(sizes) == across * down * count // each:
        raise ValueError(f"{len(places)} blocks where {across * down * count // each} are needed")
    samples = np.empty((height, width, count), stored.newbyteorder("="))
    for index, (place, size) in enumerate(zip(places, sizes, strict=True)):
        plane, at = divmod(index, across * down)
        top, left = at // across * block[0], at % across * block[1]
        lines = block[0] if tiled else min(block[0], height - top)
        raw = _expanded(content[place : place + size], lines * block[1] * each * stored.itemsize, tags)
        part = _unpredicted(raw, (lines, block[1], each), stored, _one(tags, PREDICTOR, 1))
        rows, columns = min(lines, height - top), min(block[1], width - left)
        samples[top : top + rows, left : left + columns, plane : plane + each] = part[:rows, :columns]
    return samples


def with_alpha(unit: FloatArray, tags: Tags) -> FloatArray:
    """Color and alpha (H, W, 1..4) of samples: further ones that are no alpha are left out, colors that were multiplied
    by alpha are divided by it, and white is 1.

    Args:
        unit: float32 (H, W, n), whole numbers in 0..1.
    """
    count = colors(tags)
    color = unit[..., :count]
    if _one(tags, PHOTOMETRIC, 1) == 0:
        color = 1 - color
    kinds = _all(tags, EXTRA, 2)  # without a word of what the further samples are, the first is alpha
    if unit.shape[2] == count or not kinds or kinds[0] not in (1, 2):
        return np.ascontiguousarray(color)
    alpha = np.clip(unit[..., count : count + 1], 0, 1)
    if kinds[0] == 1:
        color = np.divide(color, alpha, out=np.zeros_like(color), where=alpha > 0)
        if _one(tags, FORMAT, 1) != 3:
            color = np.minimum(color, 1)
    return np.concatenate([color, alpha], axis=2)


def _expanded(block: bytes, whole: int, tags: Tags) -> bytes:
    if _one(tags, COMPRESSION, 1) in _DEFLATED:
        block = zlib.decompressobj().decompress(block, whole)
    if len(block) < whole:
        raise ValueError(f"a block has {len(block)} of {whole} bytes")
    return block[:whole]


def _unpredicted(raw: bytes, shape: tuple[int, int, int], stored: np.dtype[Any], predictor: int) -> NDArray[Any]:
    lines, width, each = shape
    if predictor == 3 and stored.kind == "f":
        rows = np.frombuffer(raw, np.uint8).reshape(lines, -1, each)
        planes = np.cumsum(rows, axis=1, dtype=np.uint8).reshape(lines, stored.itemsize, width * each)
        joined = np.ascontiguousarray(planes.transpose(0, 2, 1))
        return joined.view(stored.newbyteorder(">")).reshape(shape)
    samples = np.frombuffer(raw, stored).reshape(shape)
    if predictor == 2 and stored.kind == "u":
        return np.cumsum(samples, axis=1, dtype=stored.newbyteorder("="))
    if predictor != 1:
        raise ValueError(f"predictor {predictor} does not go with {stored}")
    return samples


def _kind(tags: Tags) -> str | None:
    """The dtype without byte order, None where samples are of several kinds or of one that is not read."""
    kinds = {(1 if f == 4 else f, b) for f in _all(tags, FORMAT, 1) for b in _all(tags, BITS, 1)}
    return _KINDS.get(kinds.pop()) if len(kinds) == 1 else None


def _all(tags: Tags, tag: int, default: Any) -> tuple[Any, ...]:
    value = tags.get(tag, default)
    return tuple(value) if isinstance(value, tuple | list) else (value,)


def _one(tags: Tags, tag: int, default: int) -> int:
    value = _all(tags, tag, default)
    return int(value[0]) if value else default
