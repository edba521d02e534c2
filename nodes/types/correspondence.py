"""For every pixel of the input, the position of its point in the reference."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphface.nodes.types.agreement import mismatch
from graphface.nodes.types.arrays import FloatArray, Mask


@dataclass(frozen=True)
class Correspondence:
    """Input pixels to positions in the reference.

    Attributes:
        places: float32 H x W x 2, of the input's size: (x, y) in pixels of the reference; 0 off the mesh.
        inside: float32 H x W, 1 where the input's mesh is, else 0.
        valid: float32 H x W, 0..1: how far the reference shows the point at `places`.
        size: (height, width) of the reference.
        mirrored: float32 H x W x 2, the position of the point's mirror image on the other half of the face, or None.
        mirrored_valid: float32 H x W, 0..1: weight of the mirror image, 0 where the reference shows the point itself;
            or None.
    """

    places: FloatArray
    inside: Mask
    valid: Mask
    size: tuple[int, int]
    mirrored: FloatArray | None = None
    mirrored_valid: FloatArray | None = None

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        maps = {"inside": "H W", "valid": "H W", "mirrored_valid": "H W"}
        return mismatch(self, {"places": "H W 2", "mirrored": "H W 2", **maps})

    @property
    def known(self) -> Mask:
        """float32 H x W, 0..1: how far the reference shows the point or its mirror image."""
        if self.mirrored_valid is None:
            return self.valid
        both: Mask = np.maximum(self.valid, self.mirrored_valid)
        return both


@dataclass(frozen=True)
class Pins:
    """Correspondences set by hand.

    Attributes:
        points: float32 (n, 4), each row x, y in the input and x, y in the reference, in pixels.
    """

    points: FloatArray

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        return mismatch(self, {"points": "N 4"})

    @classmethod
    def coerce(cls, value: Any) -> Pins:
        """An array or list of rows.

        Raises:
            ValueError: it is not (n, 4) finite numbers.
        """
        points = np.asarray(value, np.float32)
        if points.ndim != 2 or points.shape[1] != 4 or not np.isfinite(points).all():
            raise ValueError(f"pins are finite numbers of shape (n, 4), got shape {points.shape}")
        return cls(points)
