"""OpenEXR panoramas: the part of the format that environment maps use.

Read: single-part scan-line files with half or float channels R, G, B (or Y), without compression or with RLE, ZIPS or
ZIP. Written: without compression, as float. (The OpenCV builds on the package index have no OpenEXR.) The format is
described in "OpenEXR File Layout", openexr.com.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.io.picture_size import check_size
from graphface.nodes.types import FloatArray

_MAGIC = b"\x76\x2f\x31\x01"


_LINES = {0: 1, 1: 1, 2: 1, 3: 16}
"""Scan lines in a block, by compression: none, RLE, ZIPS, ZIP."""


_DTYPES: dict[int, np.dtype[Any]] = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}


_FURTHER = 36
"""Bytes a pixel beside the channels: the joined picture, what is finite in it, and a block while it is expanded."""


@dataclass(frozen=True)
class _Header:
    channels: list[tuple[str, np.dtype[np.generic]]]
    compression: int
    left: int
    top: int
    width: int
    height: int
    end: int


def read_exr(path: Path) -> FloatArray:
    """Read radiance, float32 H x W x 3; a single channel Y is repeated.

    Raises:
        UnreadableFile: not OpenEXR, damaged, or of a kind that is not read (tiled, deep, PIZ ...).
    """
    data = path.read_bytes()
    try:
        header = _header(data, path)
        planes = _planes(data, header)
    except (struct.error, zlib.error, ValueError, IndexError, KeyError, OverflowError) as error:
        raise UnreadableFile(path, f"damaged OpenEXR file ({type(error).__name__}: {error})") from None
    names = ["R", "G", "B"] if "R" in planes else ["Y", "Y", "Y"]
    if any(name not in planes for name in names):
        raise UnreadableFile(path, f"has channels {', '.join(planes)}; R, G and B (or Y) are needed")
    return np.stack([planes[name] for name in names], axis=2)


def write_exr(radiance: FloatArray, path: Path) -> None:
    """Write radiance float32 H x W x 3, without compression.

    Raises:
        UnwritableFile: the folder cannot be written to.
    """
    height, width = radiance.shape[:2]
    channels = b"".join(name + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    attributes = [
        (b"channels", b"chlist", channels),
        (b"compression", b"compression", b"\0"),
        (b"dataWindow", b"box2i", window),
        (b"displayWindow", b"box2i", window),
        (b"lineOrder", b"lineOrder", b"\0"),
        (b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
        (b"screenWindowWidth", b"float", struct.pack("<f", 1)),
    ]
    head = _MAGIC + struct.pack("<i", 2)
    head += b"".join(n + b"\0" + kind + b"\0" + struct.pack("<i", len(v)) + v for n, kind, v in attributes) + b"\0"
    size = 12 * width
    first = len(head) + 8 * height
    offsets = struct.pack(f"<{height}Q", *(first + y * (8 + size) for y in range(height)))
    lines = np.ascontiguousarray(radiance[..., ::-1].transpose(0, 2, 1), dtype="<f4")  # B, G, R planes by line
    body = b"".join(struct.pack("<2i", y, size) + lines[y].tobytes() for y in range(height))
    try:
        path.write_bytes(head + offsets + body)
    except OSError as error:
        raise UnwritableFile(path, error.strerror or str(error)) from None


def _header(data: bytes, path: Path) -> _Header:
    if data[:4] != _MAGIC:
        raise UnreadableFile(path, "not an OpenEXR file")
    flags = struct.unpack_from("<I", data, 4)[0] >> 8
    if flags & 0x1A:  # tiled, deep, several parts
        raise UnreadableFile(path, "tiled, deep and multi-part OpenEXR is not read; save it as single-part scan lines")
    found: dict[str, bytes] = {}
    position = 8
    while data[position]:
        name, position = _word(data, position)
        _, position = _word(data, position)
        (size,) = struct.unpack_from("<I", data, position)
        found[name] = data[position + 4 : position + 4 + size]
        position += 4 + size
    left, top, right, bottom = struct.unpack("<4i", found["dataWindow"])
    compression = found["compression"][0]
    if compression not in _LINES:
        raise UnreadableFile(path, f"OpenEXR compression {compression} is not read; save it with ZIP or none")
    width, height = right - left + 1, bottom - top + 1
    if width < 1 or height < 1:
        raise ValueError(f"a window of {width} x {height} pixels")
    channels = _channels(found["channels"])
    check_size(path, width, height, 4 * len(channels) + _FURTHER)
    return _Header(channels, compression, left, top, width, height, position + 1)


def _channels(listed: bytes) -> list[tuple[str, np.dtype[Any]]]:
    channels: list[tuple[str, np.dtype[Any]]] = []
    position = 0
    while listed[position]:
        name, position = _word(listed, position)
        kind, _, across, down = struct.unpack_from("<iB3xii", listed, position)
        if (across, down) != (1, 1):
            raise ValueError(f"channel {name} is subsampled")
        channels.append((name, _DTYPES[kind]))
        position += 16
    return channels


def _planes(data: bytes, header: _Header) -> dict[str, FloatArray]:
    planes = {name: np.zeros((header.height, header.width), np.float32) for name, _ in header.channels}
    lines = _LINES[header.compression]
    blocks = -(-header.height // lines)
    for offset in struct.unpack_from(f"<{blocks}Q", data, header.end):
        if offset > len(data) - 8:
            raise ValueError(f"a block at byte {offset} of {len(data)}")
        y, size = struct.unpack_from("<iI", data, offset)
        row = y - header.top
        count = min(lines, header.height - row)
        if not 0 <= row < header.height:
            raise ValueError(f"a block at line {y}")
        whole = count * header.width * sum(dtype.itemsize for _, dtype in header.channels)
        block = _expanded(data[offset + 8 : offset + 8 + size], whole, header.compression)
        position = 0
        for line in range(row, row + count):
            for name, dtype in header.channels:
                planes[name][line] = np.frombuffer(block, dtype, header.width, position)
                position += dtype.itemsize * header.width
    return planes


def _expanded(block: bytes, whole: int, compression: int) -> bytes:
    """Undo compression, byte-wise differences and interleaving; a block that would grow is stored as it is."""
    if compression == 0 or len(block) == whole:
        return block
    raw = _run_lengths(block) if compression == 1 else zlib.decompressobj().decompress(block, whole)
    coded: NDArray[np.uint8] = np.frombuffer(raw, np.uint8, whole)
    summed = np.cumsum(coded, dtype=np.uint8)  # modulo 256, as the differences are: each is stored plus 128
    summed[1::2] += 128
    half = (whole + 1) // 2
    joined = np.empty(whole, np.uint8)
    joined[0::2], joined[1::2] = summed[:half], summed[half:]
    return joined.tobytes()


def _run_lengths(block: bytes) -> bytes:
    parts, position = [], 0
    while position < len(block):
        (count,) = struct.unpack_from("b", block, position)
        if count < 0:
            parts.append(block[position + 1 : position + 1 - count])
            position += 1 - count
        else:
            parts.append(block[position + 1 : position + 2] * (count + 1))
            position += 2
    return b"".join(parts)


def _word(data: bytes, position: int) -> tuple[str, int]:
    end = data.index(b"\0", position)
    return data[position:end].decode("latin-1"), end + 1
