"""Environment maps: the light that comes from every direction, as an equirectangular panorama.

Rows run from straight up to straight down, columns once around. The middle column looks towards the viewer (+z), that
is, at what the person in the photo has before the eyes. As in every panorama seen from inside, the picture's right (+x)
is then on the left half: column 1/4 looks to +x, column 3/4 to -x.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import UnreadableFile, UnwritableFile
from graphface.nodes.types import FloatArray, Image

_HDR = (".hdr", ".pic")


@dataclass(frozen=True)
class Environment:
    """Light from every direction: `radiance` float32 H x W x 3, linear, 0 or more; W is usually 2 H."""

    radiance: FloatArray

    @classmethod
    def from_file(cls, path: Path) -> Environment:
        """A panorama from OpenEXR, Radiance HDR, or any picture (decoded from sRGB).

        Raises:
            UnreadableFile: not there, not such a file, or nothing in it is finite.
        """
        radiance = _read(Path(path))
        good = np.isfinite(radiance)
        if not good.any():
            raise UnreadableFile(path, "holds no finite radiance")
        return cls(np.where(good, np.maximum(radiance, 0), 0).astype(np.float32))

    @staticmethod
    def to_file(environment: Environment, path: Path) -> None:
        """Write as the suffix says: .exr (float), .hdr, or any picture (encoded to sRGB, clipped).

        Raises:
            UnwritableFile: the folder cannot be written to, or the suffix is unknown.
        """
        from graphface.nodes.envmap_exr import write_exr

        path = Path(path)
        if path.suffix.lower() == ".exr":
            write_exr(environment.radiance, path)
        elif path.suffix.lower() in _HDR:
            _write_hdr(environment.radiance, path)
        else:
            from graphface.nodes.image import write_picture

            write_picture(Environment.picture(environment), path)

    @staticmethod
    def picture(environment: Environment) -> NDArray[np.uint8]:
        """Encoded to sRGB, with the mean radiance at mid grey where it is brighter than the picture can show."""
        radiance = environment.radiance
        return Image.picture(Image(radiance / max(1.0, 4 * float(radiance.mean())), encoding="linear"))


def directions(height: int, width: int) -> NDArray[np.float64]:
    """Unit vectors (height, width, 3) that the pixels of a panorama look to, in the camera frame."""
    polar = (np.arange(height) + 0.5) / height * np.pi
    turn = ((np.arange(width) + 0.5) / width - 0.5) * 2 * np.pi
    ring = np.sin(polar)[:, None]
    y = np.broadcast_to(np.cos(polar)[:, None], (height, width))
    return np.stack([-ring * np.sin(turn), y, ring * np.cos(turn)], axis=2)


def solid_angles(height: int, width: int) -> NDArray[np.float64]:
    """Steradians of each pixel, (height, width); they sum to 4 pi exactly."""
    edges = np.cos(np.arange(height + 1) / height * np.pi)
    return np.repeat(((edges[:-1] - edges[1:]) * 2 * np.pi / width)[:, None], width, axis=1)


def _read(path: Path) -> FloatArray:
    if not path.is_file():
        raise UnreadableFile(path, "no such file")
    if path.suffix.lower() == ".exr":
        from graphface.nodes.envmap_exr import read_exr

        return read_exr(path)
    if path.suffix.lower() in _HDR:
        import cv2

        blob = np.frombuffer(path.read_bytes(), np.uint8)
        pixels = cv2.imdecode(blob, cv2.IMREAD_UNCHANGED) if len(blob) else None
        if pixels is None or pixels.ndim != 3:
            raise UnreadableFile(path, "not a Radiance HDR picture")
        return np.ascontiguousarray(pixels[..., 2::-1], dtype=np.float32)
    from graphface.nodes.colour import decode_srgb
    from graphface.nodes.image import read_image

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
