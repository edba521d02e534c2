"""What relighting computes once for all scenes (samples, surroundings), or once for a scene (shadows)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types.agreement import mismatch, out_of_range
from graphface.nodes.types.arrays import Encoding, FloatArray, Mask


@dataclass(frozen=True)
class Samples:
    """n points of a surface and what is known there before any new light: a packed G-buffer.

    Attributes:
        picture, grid: (height, width) of the picture, H x W, and of the grid that the points lie on, h x w.
        cells, pixels: intp (n,), row-major index of each point in the grid and in the picture.
        normals: float32 (n, 3), unit length.
        points: float32 (n, 3), in the camera frame, in inter-ocular distances; all 0 where they are not known.
        before: float32 (n,) or (n, 3), the photo's own shading in `encoding`.
        irradiance: float32 (n,) or (n, 3), the same in linear light, 0 or more.
        weights: float32 (n,), the face mask, 0..1.
        rim: intp, row-major indices of the grid's cells beside the surface.
        rim_weights: float32, for each of them one over the number of its neighbours (of 8) on the surface.
        coverage: float32 H x W, 1 on the surface, else 0.
        encoding: the photo's.
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

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        counted = dict.fromkeys(("cells", "pixels", "weights"), "N") | {"before": "N ...", "irradiance": "N ..."}
        cells, pixels = self.grid[0] * self.grid[1], self.picture[0] * self.picture[1]
        if self.coverage.shape != tuple(self.picture):
            return f"coverage has the shape {self.coverage.shape}, the picture is {tuple(self.picture)}"
        return (
            mismatch(self, {"normals": "N 3", "points": "N 3", **counted, "rim": "R", "rim_weights": "R"})
            or out_of_range("cells", self.cells, cells)
            or out_of_range("rim", self.rim, cells)
            or out_of_range("pixels", self.pixels, pixels)
        )


@dataclass(frozen=True)
class Surroundings:
    """How a shading on a face continues beyond it: all of `render.spread` that does not depend on the light.

    The small copy of the picture has blocks of `cell` x `cell` pixels, h x w of them.

    Attributes:
        weight: float32 H x W, 0..1: the soft face mask where there is a surface, else 0.
        cell: side of a block, pixels.
        window: (top, bottom, left, right) in blocks: the part of the copy that has the face.
        total: float32, the means of `weight` over the blocks of the window.
        nearest: intp h x w, row-major index in the window of the face block that each block takes its shading from.
        far: float32 h x w, 0..1: share of the wider of two blurs.
        sigma: standard deviation of the narrower blur, in blocks.

    Without a face, `total`, `nearest` and `far` are empty.
    """

    weight: Mask
    cell: int
    window: tuple[int, int, int, int]
    total: FloatArray
    nearest: NDArray[np.intp]
    far: FloatArray
    sigma: float

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        height, width = self.weight.shape
        if self.cell < 1:
            return f"cell is {self.cell}, expected 1 or more"
        if not (self.nearest.size or self.total.size or self.far.size):
            return None
        top, bottom, left, right = self.window
        blocks = (-(-height // self.cell), -(-width // self.cell))
        if not (0 <= top < bottom <= blocks[0] and 0 <= left < right <= blocks[1]):
            return f"window {self.window} is no part of {blocks} blocks"
        if self.total.shape != (bottom - top, right - left):
            return f"total has the shape {self.total.shape}, the window {(bottom - top, right - left)}"
        if self.nearest.shape != blocks:
            return f"nearest has the shape {self.nearest.shape}, there are {blocks} blocks"
        return mismatch(self, {"nearest": "H W", "far": "H W"}) or out_of_range(
            "nearest", self.nearest, self.total.size
        )


@dataclass(frozen=True)
class Shadows:
    """The visible share of each shadow-casting light.

    Attributes:
        lights: indices in `Scene.lights`.
        visible: float32 (len(lights), h, w), 0..1, over the whole picture on a grid that may be coarser; 1 where there
            is no surface.
    """

    lights: tuple[int, ...]
    visible: FloatArray
