"""Images to picture files, with their alpha, color profile and EXIF.

A file is written under another name and renamed when it is complete, so there is never half a picture. 16-bit color is
written without Pillow, which has no mode for it: PNG by OpenCV with metadata chunks that are inserted here, TIFF as one
strip after a directory that Pillow encodes.
"""

from __future__ import annotations

import os
import secrets
import struct
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from graphface import UnwritableFile, warn
from graphface.nodes.color import encode_srgb
from graphface.nodes.io.image_text import KEYWORD, packed, xmp_packet
from graphface.nodes.types import FileFormat, FloatArray, Image
from graphface.values.whole_file import replacing

QUALITY = 95
"""Of JPEG and WebP. JPEG keeps full color resolution (4:4:4): chroma subsampling bleeds at lips and brows."""


SUFFIXES = {".png": "PNG", ".jpg": "JPEG", ".jpeg": "JPEG", ".webp": "WEBP", ".tif": "TIFF", ".tiff": "TIFF"}


_DEFLATE_LEVEL = 2
"""zlib's, for PNG and TIFF. Measured on 12 megapixels: 5 % larger than level 6, three times faster."""


_EQUAL = 1 / 65535
"""Difference of two channels below which a pixel is grey."""


_MAX_SIDE = {"JPEG": 65_500, "WEBP": 16_383}


_MAX_JPEG_SEGMENT = 65_000


@dataclass(frozen=True)
class _Sheet:
    """The content of a file. `samples` are uint8 or uint16 (H, W, n): n is 1 for grey, 3 for RGB, 4 with alpha."""

    samples: NDArray[Any]
    icc: bytes | None = None
    exif: bytes | None = None
    text: Mapping[str, str] | None = None


def write_image(image: Image, path: Path, *, text: Mapping[str, str] | None = None) -> None:
    """Write a picture in the format that the suffix names.

    Linear light is sRGB-encoded first; values are clipped to 0..1. PNG and TIFF have 16 bits a channel where the photo
    came with 16. A grey photo is written grey while it still is.

    Args:
        image: finite pixels.
        path: .png, .jpg, .jpeg, .webp, .tif or .tiff, in a folder that exists.
        text: texts kept inside the file, see `read_text`.

    Raises:
        UnwritableFile: unknown suffix, no such folder, not permitted, disk full, too large for the format, or pixels
            that are not numbers. A file that was there before is then untouched.
    """
    path = Path(path)
    name = _format_of(path)
    pixels = encode_srgb(image.pixels) if image.encoding == "linear" else image.pixels
    if not np.isfinite(pixels).all():
        raise UnwritableFile(path, "the picture has pixels that are not numbers (NaN or infinite)")
    transparent = image.alpha is not None and name != "JPEG"
    if image.file.grey and not transparent and _is_grey(pixels):
        pixels = pixels[..., :1]
    if image.alpha is not None and not transparent:
        warn(f"{path}: JPEG has no transparency; it is left out")
    if transparent and image.alpha is not None:
        pixels = np.concatenate([pixels, image.alpha[..., None]], axis=2)
    deep = image.file.bits == 16 and name in ("PNG", "TIFF")
    icc = _fitting_profile(image.file, color=pixels.shape[2] >= 3)
    _write(path, name, _Sheet(_quantized(pixels, deep), icc, image.file.exif, text))


def write_picture(pixels: NDArray[np.uint8], path: Path, *, text: Mapping[str, str] | None = None) -> None:
    """Write an array uint8, H x W (grey), H x W x 3 (RGB) or H x W x 4 (RGB and alpha), as it is.

    Args:
        text: texts kept inside the file, see `read_text`.

    Raises:
        UnwritableFile: see `write_image`.
    """
    path = Path(path)
    samples = pixels if pixels.ndim == 3 else pixels[..., None]
    if samples.dtype != np.uint8 or samples.ndim != 3 or samples.shape[2] not in (1, 3, 4):
        raise ValueError(f"expected uint8 of H x W, H x W x 3 or H x W x 4, got {pixels.dtype} {pixels.shape}")
    name = _format_of(path)
    _write(path, name, _Sheet(samples[..., :3] if name == "JPEG" else samples, text=text))


def replace_file(path: Path, write: Callable[[Path], None]) -> None:
    """Have `write` fill a file beside `path`, then move it into place; on any failure nothing is left behind.

    Raises:
        UnwritableFile: the operating system refuses, and why.
    """
    place = Path(os.path.realpath(path))  # a link is written through
    beside = place.with_name(f".{path.name[:100]}.{secrets.token_hex(4)}.part")
    try:
        with replacing(str(place), str(beside)):
            write(beside)
    except OSError as error:
        raise UnwritableFile(path, _why(path, error)) from error


def _why(path: Path, error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        return f"the folder {path.parent} does not exist; create it first"
    if isinstance(error, PermissionError):
        return f"the folder {path.parent} may not be written to"
    return error.strerror or str(error)


def _format_of(path: Path) -> str:
    try:
        return SUFFIXES[path.suffix.lower()]
    except KeyError:
        known = ", ".join(SUFFIXES)
        what = f"unknown picture format {path.suffix!r}" if path.suffix else "the name has no suffix"
        raise UnwritableFile(path, f"{what}; use one of {known}") from None


def _is_grey(pixels: FloatArray) -> bool:
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return bool(np.abs(red - green).max(initial=0) < _EQUAL and np.abs(blue - green).max(initial=0) < _EQUAL)


def _quantized(pixels: FloatArray, deep: bool) -> NDArray[Any]:
    top, dtype = (65535, np.uint16) if deep else (255, np.uint8)
    return (np.clip(pixels, 0, 1) * np.float32(top) + np.float32(0.5)).astype(dtype)


def _fitting_profile(file: FileFormat, *, color: bool) -> bytes | None:
    """The profile if it is for pictures of this kind; a grey photo may have become a colored one."""
    if file.icc is None or file.icc[16:20] == (b"RGB " if color else b"GRAY"):
        return file.icc
    if color or file.icc[16:20] != b"RGB ":
        warn("the photo's color profile does not fit the result and is left out")
    return None


def _write(path: Path, name: str, sheet: _Sheet) -> None:
    height, width = sheet.samples.shape[:2]
    if max(height, width) > _MAX_SIDE.get(name, 2**31 - 1):
        raise UnwritableFile(path, f"{width} x {height} pixels are too many for {name}; use .png or .tif")
    try:
        content = {"PNG": _png, "JPEG": _jpeg, "WEBP": _webp, "TIFF": _tiff}[name](sheet)
    except (OSError, ValueError, SystemError, cv2.error) as error:
        raise UnwritableFile(path, f"could not be encoded as {name} ({error})") from error
    replace_file(path, lambda beside: _fill(beside, content))


def _fill(path: Path, content: bytes) -> None:
    with path.open("xb") as file:
        file.write(content)


def _pillow(samples: NDArray[np.uint8]) -> Any:
    from PIL import Image as Pillow

    return Pillow.fromarray(np.ascontiguousarray(samples[..., 0] if samples.shape[2] == 1 else samples))


def _jpeg(sheet: _Sheet) -> bytes:
    out = BytesIO()
    _pillow(sheet.samples).save(out, "JPEG", quality=QUALITY, subsampling=0, optimize=True, **_blocks(sheet, True))
    return out.getvalue()


def _webp(sheet: _Sheet) -> bytes:
    out = BytesIO()
    _pillow(sheet.samples).save(out, "WEBP", quality=QUALITY, **_blocks(sheet, False))
    return out.getvalue()


def _blocks(sheet: _Sheet, segments: bool) -> dict[str, Any]:
    """Pillow's options for profile, EXIF and text; a segment of a JPEG holds 64 KB, and what is longer is left out."""
    xmp = xmp_packet(sheet.text) if sheet.text else None
    exif = sheet.exif
    if segments and xmp is not None and len(xmp) > _MAX_JPEG_SEGMENT:
        warn("the text is too long for a JPEG and is left out; use .png for it")
        xmp = None
    if segments and exif is not None and len(exif) > _MAX_JPEG_SEGMENT:
        warn("the EXIF is too long for a JPEG and is left out")
        exif = None
    blocks = {"icc_profile": sheet.icc, "exif": exif, "xmp": xmp}
    return {key: value for key, value in blocks.items() if value}


def _png(sheet: _Sheet) -> bytes:
    """Encoded by OpenCV, with metadata chunks inserted after the header (33 bytes: signature and IHDR)."""
    samples = sheet.samples
    if samples.shape[2] >= 3:
        samples = samples[..., [2, 1, 0, 3][: samples.shape[2]]]
    flags = [cv2.IMWRITE_PNG_COMPRESSION, _DEFLATE_LEVEL]
    done, encoded = cv2.imencode(".png", np.ascontiguousarray(samples), flags)
    if not done:
        raise ValueError("OpenCV refused")
    chunks = b""
    if sheet.icc:
        chunks += _chunk(b"iCCP", b"ICC profile\0\0" + zlib.compress(sheet.icc))
    if sheet.exif:
        chunks += _chunk(b"eXIf", sheet.exif.removeprefix(b"Exif\0\0"))
    if sheet.text:
        chunks += _chunk(b"iTXt", KEYWORD.encode() + b"\0" + bytes(4) + packed(sheet.text).encode())
    content = encoded.tobytes()
    return content[:33] + chunks + content[33:]


def _chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def _tiff(sheet: _Sheet) -> bytes:
    """One deflated strip of horizontal differences; TIFF 6.0 and its Technical Note 2."""
    from PIL import ExifTags, TiffImagePlugin
    from PIL.Image import Exif

    samples = np.ascontiguousarray(sheet.samples.astype(sheet.samples.dtype.newbyteorder("<")))
    height, width, channels = samples.shape
    differences = samples.copy()
    differences[:, 1:] -= samples[:, :-1]
    strip = zlib.compress(differences.tobytes(), _DEFLATE_LEVEL)
    directory = TiffImagePlugin.ImageFileDirectory_v2(b"II\x2a\x00\x08\x00\x00\x00")
    if sheet.exif:
        exif = Exif()
        exif.load(sheet.exif)
        for tag, value in exif.items():
            directory[tag] = value
        for inner in (ExifTags.IFD.Exif, ExifTags.IFD.GPSInfo):
            if values := exif.get_ifd(inner):
                directory[inner] = dict(values)
    directory[256], directory[257] = width, height
    directory[258] = (samples.dtype.itemsize * 8,) * channels
    directory[259] = 8  # deflate
    directory[262] = 2 if channels >= 3 else 1  # RGB, or black is zero
    directory[277] = channels
    directory[278] = height
    directory[284] = 1  # channels interleaved
    directory[317] = 2  # horizontal differences
    if channels == 4:
        directory[338] = 2  # alpha, not premultiplied
    directory[273], directory[279] = 0, len(strip)
    if sheet.icc:
        directory.tagtype[34675] = 7
        directory[34675] = sheet.icc
    if sheet.text:
        directory.tagtype[700] = 1
        directory[700] = xmp_packet(sheet.text)
    out = BytesIO()
    directory.save(out)
    return out.getvalue() + strip
