"""Numbers as grey and as color, with the scale in words. What is not finite has a color of its own."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

NON_FINITE = (255, 0, 255)
"""Magenta, which no grey is: NaN and infinity in every drawing."""


def as_bytes(unit: NDArray[np.floating[Any]]) -> NDArray[np.uint8]:
    """Values in 0..1, H x W or H x W x 3, as uint8 H x W x 3: clipped, and magenta where they are not finite.

    >>> as_bytes(np.array([[0.5, 7, np.nan]])).tolist()
    [[[128, 128, 128], [255, 255, 255], [255, 0, 255]]]
    """
    scaled = np.multiply(unit, 255, dtype=np.float32)
    finite = bool(np.isfinite(scaled.sum()))
    shown = scaled if finite else np.nan_to_num(scaled, nan=0, posinf=255, neginf=0)
    pixels: NDArray[np.uint8] = np.rint(np.clip(shown, 0, 255)).astype(np.uint8)
    if pixels.ndim == 2:
        pixels = np.repeat(pixels[..., None], 3, axis=2)
    if not finite:
        mark_odd(pixels, scaled)
    return pixels


def grey_of(values: NDArray[Any]) -> tuple[NDArray[np.uint8], str]:
    """Values H x W (x 3) by their own range, with the scale in words: around mid grey where there are both signs."""
    values = values.astype(np.float32)
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
    if low < 0 < high:
        high = max(-low, high)
        low, note = -high, f"mid grey is 0, black {-high:.4g}, white {high:.4g}"
    elif low == high:
        note = f"{low:.4g} everywhere" if finite.size else ""
        low, high = low - 0.5, high + 0.5
    else:
        note = f"black is {low:.4g}, white {high:.4g}"
    pixels = as_bytes((values - low) / max(high - low, 1e-30))
    return pixels, with_odd(note, values)


def with_odd(note: str, values: NDArray[Any]) -> str:
    """A note that also tells how many values are not finite, if any."""
    if values.dtype.kind not in "fc" or not values.size or np.isfinite(values.sum(dtype=np.float64)):
        return note
    odd = int(not_finite(values).sum()) if values.ndim > 2 else int((~np.isfinite(values)).sum())
    words = f"magenta: not finite ({odd} pixel{'s' if odd != 1 else ''})" if odd else ""
    return "; ".join(part for part in (note, words) if part)


def share_beyond(values: NDArray[Any], limit: float) -> float:
    """The share of the pixels of H x W (x C) with a value above a limit or below its negative."""
    if not values.size or (values.max() <= limit and values.min() >= -limit):
        return 0.0
    channels = [values] if values.ndim == 2 else [values[..., channel] for channel in range(values.shape[2])]
    return float(np.logical_or.reduce([np.abs(channel) > limit for channel in channels]).mean())


def not_finite(values: NDArray[Any]) -> NDArray[np.bool_]:
    """Where H x W has no finite number, or H x W x C a channel without: bool H x W."""
    finite: NDArray[np.bool_] = np.isfinite(values if values.ndim == 2 else values[..., 0])
    for channel in range(1, values.shape[2] if values.ndim == 3 else 0):
        finite &= np.isfinite(values[..., channel])
    return ~finite


def mark_odd(pixels: NDArray[np.uint8], values: NDArray[Any]) -> None:
    """Make the pixels magenta where a value H x W (x C) is not finite."""
    if values.dtype.kind == "f" and not np.isfinite(values.sum()):
        pixels[not_finite(values)] = NON_FINITE
