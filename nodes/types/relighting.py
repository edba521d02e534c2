"""What relighting works out once for all scenes, or once for a scene: samples, shadows, surroundings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types.arrays import Encoding, FloatArray, Mask


@dataclass(frozen=True)
class Samples:
    """n points of a surface and what is known there before any new light (a G-buffer, packed).

    `picture` and `grid` are heights and widths; `cells` and `pixels` intp (n,) the points' places in the two, counted
    row by row. `normals` (n, 3) unit length; `points` (n, 3) in the camera frame, inter-ocular distances, all 0 where
    they are not known. `before` is the photo's own shading, (n,) or (n, 3), in `encoding`; `irradiance` the same in
    linear light, not negative; `weights` (n,) the face's mask. `rim` are cells beside the surface, and `rim_weights`
    what the sum over the 3 x 3 cells around them must be multiplied by to be the mean of those on the surface.
    `coverage` H x W is 1 on the surface.
    """

    picture: tuple[int, int]
    grid: tuple[int, int]
    cells: NDArray[np.intp]
    pixels: NDArray[np.intp]
    normals: FloatArray
    points: FloatArray
    before: FloatArray
    irradiance: FloatArray
    weights: FloatArray
    rim: NDArray[np.intp]
    rim_weights: FloatArray
    coverage: Mask
    encoding: Encoding


@dataclass(frozen=True)
class Surroundings:
    """How a shading goes on beyond a face: all of `render.spread` that the light does not change.

    `weight` H x W is the soft mask where there is a surface. The small copy has cells of `cell` x `cell` pixels, h x w
    of them; the face lies in the cells `window` (top, bottom, left, right). `total` are the weight's means over the
    window's cells; `nearest` intp h x w, the place of the face cell that each cell copies, counted row by row in the
    window; `far` h x w, 0..1, how much of the wider of two blurs it takes; `sigma`, the narrower's width in cells.
    Without a face all but `weight` are empty.
    """

    weight: Mask
    cell: int
    window: tuple[int, int, int, int]
    total: FloatArray
    nearest: NDArray[np.intp]
    far: FloatArray
    sigma: float


@dataclass(frozen=True)
class Shadows:
    """How much of each casting light arrives.

    `lights` are places in `Scene.lights`; `visible` float32 (len(lights), h, w), 0..1, over the whole picture on a grid
    that may be coarser than the picture's, 1 where there is no surface.
    """

    lights: tuple[int, ...]
    visible: FloatArray

    @staticmethod
    def picture(shadows: Shadows) -> NDArray[np.uint8]:
        """The maps side by side."""
        tiles = list(shadows.visible) or [np.ones(shadows.visible.shape[1:], np.float32)]
        grey = np.rint(np.concatenate(tiles, axis=1) * 255).astype(np.uint8)
        return np.repeat(grey[..., None], 3, axis=2)
