"""Pictures of a report: as people see them, and what is under each pixel. Equal ones are stored once."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import blake2b
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.report.packing import Packed, pack
from graphface.values.picture import Picture

QUALITY, METHOD = 80, 2
"""Of WebP. Measured on the 31 maps of a relight at 256 pixels: 100 kB, 43.7 dB, 76 ms of CPU; JPEG takes 177 kB for
43.5 dB in 10 ms, WebP's default method 96 kB for 44.1 dB in 135 ms."""


@dataclass(frozen=True)
class Sheet:
    """One picture of a value.

    Attributes:
        label: the field of the value that is shown, "" for the value itself. type: its declared type.
        image: a blob. packed: the values, a blob for each channel; None where a pixel has no value.
        full: height and width of the array that the data were sampled from.
    """

    label: str
    type: str
    note: str
    width: int
    height: int
    image: int
    packed: Packed | None = None
    planes: tuple[int, ...] = ()
    channels: tuple[str, ...] = ()
    full: tuple[int, int] | None = None


class Blobs:
    """Bytes by index; what is added twice is there once.

    Channels are apart, since a value and one of its fields often share some.
    """

    def __init__(self) -> None:
        self.contents: list[bytes] = []
        self._known: dict[bytes, int] = {}
        self._images: dict[bytes, int] = {}
        self._packed: dict[bytes, Packed | None] = {}

    def sheet(self, label: str, declared: str, picture: Picture) -> Sheet:
        """A picture, encoded and packed."""
        height, width = picture.pixels.shape[:2]
        image, data = self._image(picture.pixels), picture.data
        packed = self._pack(data) if data is not None else None
        if packed is None or data is None:
            return Sheet(label, declared, picture.note, width, height, image)
        planes = tuple(self.add(plane) for plane in packed.planes)
        full = picture.full or (data.shape[0], data.shape[1])
        return Sheet(label, declared, picture.note, width, height, image, packed, planes, picture.channels, full)

    def _image(self, pixels: NDArray[np.uint8]) -> int:
        digest = _digest(pixels)
        if digest not in self._images:
            from PIL import Image

            stream = BytesIO()
            Image.fromarray(pixels).save(stream, "WEBP", quality=QUALITY, method=METHOD)
            self._images[digest] = self.add(stream.getvalue())
        return self._images[digest]

    def _pack(self, data: NDArray[Any]) -> Packed | None:
        digest = _digest(data)
        if digest not in self._packed:
            self._packed[digest] = pack(data)
        return self._packed[digest]

    def add(self, content: bytes) -> int:
        """The index of a content, which is stored where it is new."""
        digest = blake2b(content, digest_size=16).digest()
        if digest not in self._known:
            self._known[digest] = len(self.contents)
            self.contents.append(content)
        return self._known[digest]


def _digest(array: NDArray[Any]) -> bytes:
    described = f"{array.dtype}{array.shape}".encode()
    return blake2b(described + np.ascontiguousarray(array).tobytes(), digest_size=16).digest()
