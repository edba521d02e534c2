"""A photograph, and photographs from arrays."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from graphface.nodes.types.agreement import mismatch
from graphface.nodes.types.arrays import Encoding, FloatArray, Mask
from graphface.nodes.types.from_pillow import is_pillow, pillow_array


@dataclass(frozen=True)
class FileFormat:
    """What a picture file has besides its pixels, kept so that saving restores it.

    Attributes:
        name: "PNG", "JPEG", "WEBP" or "TIFF".
        bits: per channel, 8 or 16.
        icc: the raw color profile, or None.
        exif: the raw EXIF block without its orientation, which is already applied; or None.
        grey: whether the file has a single channel.
    """

    name: str = "PNG"
    bits: int = 8
    icc: bytes | None = None
    exif: bytes | None = None
    grey: bool = False


@dataclass(frozen=True)
class Image:
    """A photograph.

    Attributes:
        pixels: float32 H x W x 3, RGB, nominally 0..1.
        alpha: float32 H x W, 0..1, or None.
        encoding: of the pixels, "srgb" or "linear".
        file: what its file had besides.
    """

    pixels: FloatArray
    alpha: Mask | None = None
    encoding: Encoding = "srgb"
    file: FileFormat = FileFormat()

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        if self.encoding not in ("srgb", "linear"):
            return f"encoding is {self.encoding!r}, expected 'srgb' or 'linear'"
        return mismatch(self, {"pixels": "H W 3", "alpha": "H W"}) or (None if self.pixels.size else "it has no pixels")

    @property
    def height(self) -> int:
        return int(self.pixels.shape[0])

    @property
    def width(self) -> int:
        return int(self.pixels.shape[1])

    def with_pixels(self, pixels: FloatArray, encoding: Encoding | None = None) -> Image:
        """The same picture with other pixels: alpha and what the file carried are kept."""
        return replace(self, pixels=pixels.astype(np.float32, copy=False), encoding=encoding or self.encoding)

    @classmethod
    def coerce(cls, value: object) -> Image:
        return image_from_array(value)

    def save(self, path: str | Path) -> None:
        """Write it to a file, PNG, JPEG, WebP or TIFF by the suffix, with what its own file had besides.

        Raises:
            UnwritableFile: the folder refuses, or the suffix is another.
        """
        from graphface.registry import default_registry
        from graphface.values.port_types import PortType
        from graphface.values.writing import write_output

        write_output(self, PortType((Image,)), Path(path), default_registry().files)

    def _repr_png_(self) -> bytes:
        """What a notebook shows."""
        import io

        import PIL.Image

        from graphface.pictures import draw
        from graphface.registry import default_registry
        from graphface.values.picture import View
        from graphface.values.port_types import PortType

        picture = draw(self, PortType((Image,)), default_registry(), View(size=_SHOWN))
        held = io.BytesIO()
        PIL.Image.fromarray(picture.pixels).save(held, "PNG")
        return held.getvalue()


_SHOWN = 1000
"""Longer side, in pixels, of a photo in a notebook."""
BRIGHTEST = 64.0
"""Largest value of a floating-point picture; one with larger values is probably in 0..255, and refused."""


def image_from_array(value: object) -> Image:
    """A picture from an array.

    Args:
        value: an `Image` (returned as it is), or an array of H x W, H x W x 1 (grey), H x W x 3 (RGB) or H x W x 4
            (RGB and alpha): uint8, uint16, bool, or floating in 0..1, of either byte order; or a picture of Pillow.
            It is copied.

    Raises:
        ValueError: another shape, dtype or range, no pixels, or values that are not numbers.
    """
    if isinstance(value, Image):
        return value
    array = pillow_array(value) if is_pillow(value) else np.asarray(value)
    array = array.astype(array.dtype.newbyteorder("="), copy=False)
    if array.ndim == 2:
        array = array[..., None]
    if array.ndim != 3 or array.shape[2] not in (1, 3, 4) or array.size == 0:
        raise ValueError(
            f"expected a picture of H x W, H x W x 3 or H x W x 4, got {type(value).__name__} of shape {array.shape}"
        )
    unit = _unit(array)
    channels = unit.shape[2]
    pixels = np.repeat(unit, 3, axis=2) if channels == 1 else np.ascontiguousarray(unit[..., :3])
    alpha = np.ascontiguousarray(unit[..., 3]) if channels == 4 else None
    bits = 16 if array.dtype.itemsize > 1 else 8
    return Image(pixels, alpha, file=FileFormat(bits=bits, grey=channels == 1))


def _unit(array: np.ndarray[Any, np.dtype[Any]]) -> FloatArray:
    """A float32 copy in 0..1."""
    if array.dtype in (np.uint8, np.uint16):
        return array.astype(np.float32) / np.float32(np.iinfo(array.dtype).max)
    if array.dtype == np.bool_:
        return array.astype(np.float32)
    if array.dtype.kind != "f":
        raise ValueError(f"expected a picture of uint8, uint16, bool or floating values, got {array.dtype}")
    if not np.isfinite(array).all():
        raise ValueError("the picture has values that are not numbers (NaN or infinite)")
    brightest = float(np.abs(array).max())
    if brightest > BRIGHTEST:
        raise ValueError(f"floating pictures are nominally 0..1, this one reaches {brightest:.4g}; divide it by 255?")
    return array.astype(np.float32)
