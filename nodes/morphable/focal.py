"""The focal length in the metadata of a photo."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import Image

_EXIF_IFD, _FOCAL_35MM = 0x8769, 0xA405


_DIAGONAL_35MM = float(np.hypot(36, 24))


def focal_length(photo: Image) -> float | None:
    """The focal length in pixels, from EXIF's 35 mm equivalent; None where the photo has none.

    The equivalent is by the diagonal (CIPA DCG-001). It is wrong for a photo that was cropped afterwards.
    """
    if not photo.file.exif:
        return None
    from PIL.Image import Exif

    exif = Exif()
    try:
        exif.load(photo.file.exif)
        equivalent = float(exif.get_ifd(_EXIF_IFD).get(_FOCAL_35MM, 0))
    except (SyntaxError, ValueError, TypeError, KeyError, OSError):
        return None
    if not 1 <= equivalent <= 5000:
        return None
    return equivalent / _DIAGONAL_35MM * float(np.hypot(photo.width, photo.height))
