"""Pictures that Pillow holds, as arrays."""

from __future__ import annotations

from typing import Any

import numpy as np


def is_pillow(value: object) -> bool:
    """Whether a value is a picture of Pillow; Pillow is not imported for that."""
    return any(kind.__module__ == "PIL.Image" and kind.__name__ == "Image" for kind in type(value).__mro__)


def pillow_array(image: Any) -> np.ndarray[Any, np.dtype[Any]]:
    """Grey, RGB or RGB with alpha in the bits that it has; upright by its EXIF orientation.

    Palettes and other color models become RGB as Pillow converts them.
    """
    from PIL import ImageOps

    upright = ImageOps.exif_transpose(image)
    if upright.mode not in ("1", "L", "RGB", "RGBA", "F") and not upright.mode.startswith("I"):
        alpha = upright.mode in ("LA", "PA", "La", "RGBa") or "transparency" in upright.info
        upright = upright.convert("RGBA" if alpha else "RGB")
    return np.array(upright)
