"""For every pixel of the input, its point's place in the reference."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types.arrays import FloatArray, Mask


@dataclass(frozen=True)
class Correspondence:
    """Input pixel to reference pixel.

    `places` float32 H x W x 2, of the input's size: (x, y) in the reference, 0 off the mesh; `inside` H x W: 1
    where the input's mesh lies; `valid` H x W: how far the reference shows the point at that place. Where it does not,
    `mirrored` (H x W x 2, or None) is the place of the point's mirror image on the other half of the face, as far as
    `mirrored_valid` says. `size` is the reference's (height, width).
    """

    places: FloatArray
    inside: Mask
    valid: Mask
    size: tuple[int, int]
    mirrored: FloatArray | None = None
    mirrored_valid: FloatArray | None = None

    @property
    def known(self) -> Mask:
        """How far either place shows the point."""
        if self.mirrored_valid is None:
            return self.valid
        both: Mask = np.maximum(self.valid, self.mirrored_valid)
        return both

    @staticmethod
    def picture(correspondence: Correspondence) -> NDArray[np.uint8]:
        """A checkerboard of the reference carried to the input; grey where nothing is known."""
        height, width = correspondence.size
        cell = max(height, width, 1) / 32
        board = (np.floor(correspondence.places / cell).sum(axis=2) % 2) * 0.6 + 0.2
        shown = np.where(correspondence.inside * correspondence.valid > 0.5, board, 0.5)
        return np.repeat(np.rint(shown * 255).astype(np.uint8)[..., None], 3, axis=2)


@dataclass(frozen=True)
class Pins:
    """Correspondences set by hand: float32 (n, 4), each row x, y in the input and x, y in the reference."""

    points: FloatArray

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
