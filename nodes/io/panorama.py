"""Files of environment maps: OpenEXR, Radiance HDR, or any picture."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.io.exr import read_exr, write_exr
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture
from graphface.nodes.io.picture_size import check_size
from graphface.nodes.types import Environment, FloatArray
from graphface.pictures.colors import as_bytes

_HDR = (".hdr", ".pic")

_RESOLUTION = re.compile(rb"\n[-+][XY] +(\d{1,9}) +[-+][XY] +(\d{1,9})\n")
"""The line of a Radiance header that has the size."""


def read_panorama(path: Path) -> Environment:
    """A panorama from OpenEXR, Radiance HDR, or any picture (decoded from sRGB).

    Raises:
        UnreadableFile: not there, not such a file, or nothing in it is finite.
    """
    radiance = _read(Path(path))
    good = np.isfinite(radiance)
    if not good.any():
        raise UnreadableFile(path, "holds no finite radiance")
    np.copyto(radiance, 0, where=~good)
    return Environment(np.maximum(radiance, 0, out=radiance))


def write_panorama(environment: Environment, path: Path) -> None:
    """Write in the format of the suffix: .exr (float), .hdr, or any picture (encoded to sRGB, clipped).

    Raises:
        UnwritableFile: the folder cannot be written to, or the suffix is unknown.
    """
    path = Path(path)
    if path.suffix.lower() == ".exr":
        write_exr(environment.radiance, path)
    elif path.suffix.lower() in _HDR:
        _write_hdr(environment.radiance, path)
    else:
        white = max(1.0, 4 * float(environment.radiance.mean()))  # brighter ones have their mean at mid grey
        write_picture(as_bytes(encode_srgb(environment.radiance / np.float32(white))), path)


def _read(path: Path) -> FloatArray:
    if not path.is_file():
        raise UnreadableFile(path, "no such file")
    if path.suffix.lower() == ".exr":
        return read_exr(path)
    if path.suffix.lower() in _HDR:
        import cv2

        content = path.read_bytes()
        size = _RESOLUTION.search(content[:65536])
        if size is None:
            raise UnreadableFile(path, "not a Radiance HDR picture")
        check_size(path, int(size[2]), int(size[1]), 30)
        try:
            pixels = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_UNCHANGED)
        except cv2.error as error:
            raise UnreadableFile(path, f"damaged Radiance HDR picture ({error.err})") from None
        if pixels is None or pixels.ndim != 3:
            raise UnreadableFile(path, "not a Radiance HDR picture")
        return np.ascontiguousarray(pixels[..., 2::-1], dtype=np.float32)
    image = read_image(path)
    return image.pixels if image.encoding == "linear" else decode_srgb(image.pixels)


def _write_hdr(radiance: FloatArray, path: Path) -> None:
    import cv2

    done, blob = cv2.imencode(".hdr", np.ascontiguousarray(radiance[..., ::-1]))
    if not done:
        raise UnwritableFile(path, "could not be encoded as Radiance HDR")
    try:
        path.write_bytes(blob.tobytes())
    except OSError as error:
        raise UnwritableFile(path, error.strerror or str(error)) from None
