"""The value that carries shadows from the node that finds them to the node that shades."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray


@dataclass(frozen=True)
class Shadows:
    """How much of each casting light arrives.

    `lights` are places in `Scene.lights`; `visible` float32 (len(lights), h, w), 0..1, over the whole picture on a grid
    that may be coarser than the picture's, 1 where there is no surface.
    """

    lights: tuple[int, ...]
    visible: FloatArray

    def of(self, light: int, shape: tuple[int, ...]) -> FloatArray:
        """The map of one of `lights` at the picture's size (height, width)."""
        import cv2

        grid: FloatArray = self.visible[self.lights.index(light)]
        if grid.shape == shape:
            return grid
        return np.asarray(cv2.resize(grid, (shape[1], shape[0]), interpolation=cv2.INTER_LINEAR), np.float32)

    @staticmethod
    def picture(shadows: Shadows) -> NDArray[np.uint8]:
        """The maps side by side."""
        tiles = list(shadows.visible) or [np.ones(shadows.visible.shape[1:], np.float32)]
        grey = np.rint(np.concatenate(tiles, axis=1) * 255).astype(np.uint8)
        return np.repeat(grey[..., None], 3, axis=2)
