"""Picture files to images: 8- and 16-bit PNG, JPEG, WebP and TIFF.

The header is read first and alone, by Pillow: a file that claims more pixels, or would take more memory, than is
allowed (`picture_size`) is refused before anything is allocated. Pillow then decodes 8-bit files; it silently halves
16-bit color, which OpenCV decodes.

Pixels are taken as sRGB. An embedded profile is kept beside them and attached again on saving, so a picture in another
RGB space comes back in it; only the light estimated in between is off by the difference of the spaces.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import ExifTags, ImageFile, JpegImagePlugin, PngImagePlugin, TiffImagePlugin, WebPImagePlugin
from PIL.Image import DecompressionBombError, Exif

from graphface import UnreadableFile, warn
from graphface.nodes.io import tiff
from graphface.nodes.io.picture_size import check_size
from graphface.nodes.types import FileFormat, FloatArray, Image

ORIENTATION = 274


BITS_PER_SAMPLE = 258


ICC_PROFILE = 34675


_KEPT_TIFF_TAGS = (270, 271, 272, 305, 306, 315, 33432)
"""Description, make, model, software, time, artist, copyright: the tags of a TIFF that are kept as its EXIF."""


_DAMAGE = (
    OSError,
    ValueError,
    SyntaxError,
    EOFError,
    KeyError,
    IndexError,
    TypeError,
    OverflowError,
    cv2.error,
    zlib.error,
    struct.error,
)
"""What Pillow and OpenCV raise on damaged files, depending on where the damage is."""


@dataclass
class Picture:
    """An opened file of which only the header is read. `tags` are a TIFF's; `image` is None for a TIFF that Pillow
    cannot decode (floating-point color)."""

    format: str
    image: Any
    tags: dict[int, Any]
    width: int
    height: int
    bits: int


def read_image(path: Path) -> Image:
    """The picture in a file: float32 RGB in 0..1, upright, with its alpha.

    EXIF orientation is applied; grey, palette and CMYK become RGB; of an animation the first frame is taken, with a
    warning. ICC profile and EXIF are kept in `Image.file`, without the thumbnail: it would show the unedited photo.

    Raises:
        UnreadableFile: missing, no picture, damaged, of a format that is not read, too large (`picture_size`), or
            with values that are not numbers.
    """
    path = Path(path)
    with open_picture(path) as picture:
        check_size(path, picture.width, picture.height, _bytes_per_pixel(picture))
        frames = int(getattr(picture.image, "n_frames", 1))
        if frames > 1:
            warn(f"{path} has {frames} pictures: the first is taken")
        orientation, exif = _exif(path, picture)
        icc = picture.tags.get(ICC_PROFILE) if picture.format == "TIFF" else picture.image.info.get("icc_profile")
        samples, grey, icc = _decode(path, picture, icc)
        if picture.format == "TIFF" and _already_upright(picture):
            orientation = 1
    upright = np.ascontiguousarray(_upright(samples, orientation))
    pixels = np.repeat(upright[..., :1], 3, axis=2) if grey else np.ascontiguousarray(upright[..., :3])
    alpha = np.ascontiguousarray(upright[..., -1]) if upright.shape[2] in (2, 4) else None
    bits = 16 if picture.bits > 8 else 8
    return Image(pixels, alpha, file=FileFormat(picture.format, bits, icc or None, exif, grey))


@contextmanager
def open_picture(path: Path) -> Iterator[Picture]:
    """The header of a picture file; closed afterwards.

    Raises:
        UnreadableFile: also for damage found while the block runs.
    """
    try:
        with path.open("rb") as file:
            yield _open(path, file)
    except UnreadableFile:
        raise
    except FileNotFoundError as error:
        raise UnreadableFile(path, "no such file") from error
    except IsADirectoryError as error:
        raise UnreadableFile(path, "is a folder, not a picture") from error
    except PermissionError as error:
        raise UnreadableFile(path, "may not be read (permission denied)") from error
    except DecompressionBombError as error:
        raise UnreadableFile(path, f"claims more pixels than can be read ({_first_line(error)})") from None
    except _DAMAGE as error:
        raise UnreadableFile(path, f"damaged or cut off ({_first_line(error)})") from error


def _open(path: Path, file: Any) -> Picture:
    start = file.read(32)
    file.seek(0)
    if start.startswith(b"\x89PNG\r\n\x1a\n"):
        image: Any = PngImagePlugin.PngImageFile(file)
        return Picture("PNG", image, {}, image.width, image.height, bits=start[24])
    if start.startswith(b"\xff\xd8\xff"):
        return _plain("JPEG", JpegImagePlugin.JpegImageFile(file))
    if start.startswith(b"RIFF") and start[8:12] == b"WEBP":
        return _plain("WEBP", WebPImagePlugin.WebPImageFile(file))
    if start[:4] in (b"II*\0", b"MM\0*", b"II+\0"):
        return _open_tiff(file)
    if not start:
        raise UnreadableFile(path, "is empty")
    if start[:4] == b"MM\0+":  # Pillow takes its tags for others
        raise UnreadableFile(path, "is a big-endian BigTIFF, which is not read; save it as an ordinary TIFF")
    raise UnreadableFile(path, "is not a PNG, JPEG, WebP or TIFF picture")


def _plain(name: str, image: Any) -> Picture:
    return Picture(name, image, {}, image.width, image.height, bits=8)


def _open_tiff(file: Any) -> Picture:
    header = file.read(8)
    if 43 in header[2:4]:  # BigTIFF
        header += file.read(8)
    directory = TiffImagePlugin.ImageFileDirectory_v2(header)
    file.seek(directory.next)
    directory.load(file)
    tags = dict(directory)
    bits = tags.get(BITS_PER_SAMPLE, (1,))
    bits = max(bits) if isinstance(bits, tuple) else bits
    file.seek(0)
    image: ImageFile.ImageFile | None
    try:
        image = TiffImagePlugin.TiffImageFile(file)
    except SyntaxError:  # a combination of samples that Pillow has no mode for; OpenCV may
        image = None
    return Picture("TIFF", image, tags, int(tags[256]), int(tags[257]), int(bits))


def _bytes_per_pixel(picture: Picture) -> float:
    """What reading takes: samples as decoded and in order, then float32, once more where they are split from alpha."""
    channels = len(picture.image.getbands()) if picture.image is not None else 3
    palette = picture.image is not None and picture.image.mode == "P"
    alpha = channels in (2, 4) or (picture.image is not None and "transparency" in picture.image.info)
    channels = 4 if palette and alpha else max(channels, 3, int(picture.tags.get(tiff.SAMPLES, 1)))
    return channels * (2 * max(picture.bits, 8) / 8 + 4) + (16 if alpha else 1)


def _exif(path: Path, picture: Picture) -> tuple[int, bytes | None]:
    """The orientation (1..8), and the EXIF block without it and without the thumbnail."""
    exif, orientation, block = Exif(), 1, None
    try:
        if picture.format == "TIFF":
            exif = _exif_of_tiff(picture)
        else:
            exif.load(picture.image.info.get("exif") or b"")
        orientation = exif.pop(ORIENTATION, 1)
        if picture.format != "TIFF":
            exif.get_ifd(ExifTags.IFD.Exif)  # read now, so that damage shows here
            exif.get_ifd(ExifTags.IFD.GPSInfo)
        block = exif.tobytes() if len(exif) else None
    except Exception as error:  # whatever Pillow raises: the pixels are good
        warn(f"{path}: its EXIF is damaged and dropped ({_first_line(error)})")
    return (orientation if orientation in range(1, 9) else 1), block


def _exif_of_tiff(picture: Picture) -> Any:
    exif = Exif()
    for tag in (*_KEPT_TIFF_TAGS, ORIENTATION):
        if tag in picture.tags:
            exif[tag] = picture.tags[tag]
    if picture.image is not None:
        source = picture.image.getexif()
        for directory in (ExifTags.IFD.Exif, ExifTags.IFD.GPSInfo):
            values = source.get_ifd(directory)
            if values:
                exif[directory] = dict(values)
    return exif


def _decode(path: Path, picture: Picture, icc: bytes | None) -> tuple[FloatArray, bool, bytes | None]:
    """Samples float32 (H, W, 1..4), whether they are grey, and the profile that fits them."""
    if picture.format == "TIFF":
        samples = _decode_tiff(path, picture)
        if samples is not None:
            return samples, samples.shape[2] <= 2, icc
    if picture.bits > 8 or picture.image is None:
        samples = _decode_deep(path, picture)
        return samples, samples.shape[2] <= 2, icc
    image = picture.image
    image.load()
    if image.mode == "CMYK":
        return _unit(_cmyk_to_srgb(path, image, icc)), False, None
    has_alpha = "transparency" in image.info or image.mode in ("LA", "PA", "La", "RGBA", "RGBa")
    grey = image.mode in ("1", "L", "LA", "La")
    mode = {(True, False): "L", (True, True): "LA", (False, False): "RGB", (False, True): "RGBA"}[grey, has_alpha]
    samples = np.asarray(image if image.mode == mode else image.convert(mode))
    return _unit(samples), grey, icc


def _decode_tiff(path: Path, picture: Picture) -> FloatArray | None:
    """Samples of a TIFF whose layout is read here, or by OpenCV; None of those that Pillow reads, refused otherwise."""
    tags = picture.tags
    if tiff.can_be_read(tags):
        return tiff.with_alpha(_finite(path, tiff.read_samples(path.read_bytes(), tags)), tags)
    deep = picture.bits > 8 or picture.image is None
    further = picture.tags.get(tiff.SAMPLES, 1) > tiff.colors(tags)
    odd = tiff.is_signed(tags) or (deep and (tiff.colors(tags) == 4 or picture.bits not in (16, 32, 64)))
    if odd or (tiff.is_planar(tags) and (deep or further)):
        raise UnreadableFile(path, f"this kind of TIFF ({_layout(picture)}) is not read; save it as RGB, deflated")
    return tiff.with_alpha(_decode_deep(path, picture), tags) if deep else None


def _layout(picture: Picture) -> str:
    """What a TIFF is like, for a message."""
    tags = picture.tags
    return (
        f"{tags.get(tiff.SAMPLES, 1)} samples of {picture.bits} bits{' in planes' if tiff.is_planar(tags) else ''}, "
        f"format {tags.get(tiff.FORMAT, 1)}, compression {tags.get(tiff.COMPRESSION, 1)}"
    )


def _cmyk_to_srgb(path: Path, image: Any, icc: bytes | None) -> NDArray[np.uint8]:
    """CMYK to sRGB by the embedded profile; without one by Pillow's formula."""
    from io import BytesIO

    from PIL import ImageCms

    if icc:
        try:
            converted = ImageCms.profileToProfile(image, BytesIO(icc), ImageCms.createProfile("sRGB"), outputMode="RGB")
            return np.asarray(converted)
        except ImageCms.PyCMSError:
            warn(f"{path}: its CMYK profile is damaged; colors are converted without it")
    return np.asarray(image.convert("RGB"))


def _decode_deep(path: Path, picture: Picture) -> FloatArray:
    """16-bit and floating-point samples, by OpenCV."""
    if picture.format == "PNG":
        picture.image.verify()  # OpenCV fills a truncated file with black, without an error
    samples = cv2.imdecode(np.fromfile(path, np.uint8), cv2.IMREAD_UNCHANGED)
    if samples is None:
        raise UnreadableFile(path, f"this kind of {picture.format} ({picture.bits} bits a channel) cannot be decoded")
    samples = samples if samples.ndim == 3 else samples[..., None]
    if samples.shape[2] >= 3:
        samples = samples[..., [2, 1, 0, 3][: samples.shape[2]]]
    return _finite(path, samples)


def _finite(path: Path, samples: NDArray[Any]) -> FloatArray:
    """Samples by `_unit`, refused where some are no numbers."""
    unit = _unit(samples)
    if samples.dtype.kind == "f" and not np.isfinite(unit).all():
        raise UnreadableFile(path, "has pixels that are not numbers (NaN or infinite)")
    return unit


def _unit(samples: NDArray[Any]) -> FloatArray:
    """float32 (H, W, channels); whole numbers are divided by their largest value."""
    samples = samples if samples.ndim == 3 else samples[..., None]
    if samples.dtype.kind == "f":
        return samples.astype(np.float32)
    unit: FloatArray = np.multiply(samples, np.float32(1 / np.iinfo(samples.dtype).max), dtype=np.float32)
    return unit


def _already_upright(picture: Picture) -> bool:
    """Whether the decoder of a TIFF has applied the orientation: OpenCV always does, newer versions of Pillow do and
    drop the tag. For other formats no decoder does."""
    if tiff.can_be_read(picture.tags):
        return False
    return picture.bits > 8 or picture.image is None or ORIENTATION not in picture.image.getexif()


def _upright(samples: FloatArray, orientation: int) -> FloatArray:
    """EXIF orientation applied: 5 to 8 are stored transposed; then mirrored along either axis."""
    if orientation >= 5:
        samples = samples.transpose(1, 0, 2)
    if orientation in (3, 4, 7, 8):
        samples = samples[::-1]
    if orientation in (2, 3, 6, 7):
        samples = samples[:, ::-1]
    return samples


def _first_line(error: BaseException) -> str:
    return str(error).strip().split("\n")[0][:120] or type(error).__name__
