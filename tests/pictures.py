"""Pictures and metadata for tests of picture files."""

from __future__ import annotations

import numpy as np
import PIL.Image as Pillow
from PIL import ImageCms

from graphface.nodes.types import FloatArray

SUFFIXES = [".png", ".jpg", ".webp", ".tif"]
LOSSLESS = [".png", ".tif"]
ICC = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
MAKE, ORIENTATION, EXPOSURE, EXIF_DIRECTORY = 271, 274, 33434, 0x8769


def smooth(height: int = 40, width: int = 60, channels: int = 3) -> FloatArray:
    """A picture without hard edges, float32 in 0..1, another ramp in every channel."""
    y, x = np.mgrid[0 : 1 : height * 1j, 0 : 1 : width * 1j]
    ramps = [x, y, 1 - x * y, (x + y) / 2]
    return np.stack(ramps[:channels], axis=-1).astype(np.float32)


def exif_block(**tags: int) -> bytes:
    """Raw EXIF with a maker, an exposure time and more tags, named `_274`."""
    exif = Pillow.Exif()
    exif[MAKE] = "Maker"
    for tag, value in tags.items():
        exif[int(tag.strip("_"))] = value
    exif.get_ifd(EXIF_DIRECTORY)[EXPOSURE] = (1, 60)
    return exif.tobytes()
