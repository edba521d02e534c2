"""Arrays without a meaning of their own: grey from smallest to largest, around mid grey where there are both signs."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.pictures.card import draw_text
from graphface.values.frozen import describe
from graphface.values.picture import Picture, View


def draw_array(array: NDArray[Any], view: View) -> Picture:
    """An array of H x W or H x W x C as grey, or in words where it is none."""
    if array.ndim not in (2, 3) or not array.size or array.dtype.kind not in "fiub":
        return draw_text(describe(array), view)
    seen = view.sampled(array)
    shown = seen if seen.ndim == 2 else seen[..., :3].mean(axis=2)
    grey, note = grey_of(shown.astype(np.float32))
    return Picture(np.repeat(grey[..., None], 3, axis=2), note, seen, full=(array.shape[0], array.shape[1]))


def grey_of(values: NDArray[np.float32]) -> tuple[NDArray[np.uint8], str]:
    """Values as grey with the scale in words; what is not finite is black."""
    finite = np.isfinite(values)
    low, high = (float(values[finite].min()), float(values[finite].max())) if finite.any() else (0.0, 0.0)
    if low < 0 < high:
        reach = max(-low, high)
        low, high, note = -reach, reach, f"mid grey is 0, black {-reach:.4g}, white {reach:.4g}"
    else:
        note = f"black is {low:.4g}, white {high:.4g}"
    unit = np.where(finite, (values - low) / max(high - low, 1e-12), 0)
    return np.rint(unit * 255).astype(np.uint8), note
