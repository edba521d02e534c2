"""Parzen densities of a photo's pixels: one soft histogram for each label, smoothed. No iteration, and one answer.

Every pixel that teaches a label puts a small Gaussian where its color and texture lie (Parzen, On Estimation of a
Probability Density Function and Mode, 1962). All have one width, so their sum is a histogram of soft bins, blurred: it
depends smoothly on every pixel and in proportion on every weight. Mixtures fitted by expectation maximization
(`masks.mixture`) stop in one of several optima; for 2 of 116 portraits noise of a tenth of an 8-bit level chose another
one, and then 3 to 6 % of a label went elsewhere.

Bins have four axes: lightness, two of color, and the strength of texture (the mean of the finer MR8 responses).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.masks.features import TEXTURE_WEIGHTS
from graphface.nodes.types import FloatArray

CELL = 0.03
"""Width of a bin in lightness and color, whose ranges are about 1."""


BEND = 0.3
"""Chroma from which bins grow wider: few pixels are more colorful, and they differ more from each other."""


TEXTURE_CELL, RESPONSES = 0.3, 4
"""Width of a bin of texture, in units of asinh of amplified responses, and how many responses are averaged."""


COLORS, TEXTURES = 2.0, 3.0
"""Greatest color, either sign, and greatest texture; what goes beyond is put into the last bin, so bins are few."""


NARROW, WIDE, BROAD = (1.0, 1.0, 1.0, 1.0), (5.0, 5.0, 5.0, 2.5), (6.0, 6.0, 6.0, 2.0)
"""Standard deviations, in bins, of the Gaussians: of a pixel; of its share `FAR`; and of "anything in this photo"."""


FAR = 0.2
"""Share of a pixel's say that reaches wide: a label goes a little beyond the very colors that it was taught."""


class Palette:
    """Densities of the pixels of one photo.

    Args:
        values: features h x w x D (see `masks.features.features`); color first, then texture if there is any.
    """

    def __init__(self, values: FloatArray) -> None:
        place = _place(np.nan_to_num(values.reshape(-1, values.shape[-1])))
        low = np.floor(place)
        share = (place - low).astype(np.float32)
        cell = (low - low.min(axis=0)).astype(np.int64)
        self._shape: tuple[int, ...] = tuple(int(n) + 2 for n in cell.max(axis=0))
        strides = np.cumprod((1, *self._shape[:0:-1]))[::-1]
        corners = np.indices((2,) * place.shape[1]).reshape(place.shape[1], -1).T
        first = cell @ strides
        self._index = np.stack([first + corner @ strides for corner in corners])
        self._share = np.stack([np.where(corner, share, 1 - share).prod(axis=1) for corner in corners])
        everything = self._smoothed(self._histogram(np.ones(len(place), np.float32)), BROAD)
        self.anything: FloatArray = np.log(self._looked_up(everything) / len(place) + 1e-12)

    def log_density(self, weights: FloatArray, *, doubt: float = 0.0, room: float = 0.0) -> FloatArray:
        """log p of every pixel's features, float32 (n,), under the density that weighted pixels make.

        Args:
            weights: (n,), at least 0: how much each pixel teaches.
            doubt: so many pixels of anything are added. Where nothing teaches the density is that of anything.
            room: standard deviation by which lightness is spread beside the bins' own.
        """
        histogram = self._histogram(weights)
        narrow = (float(np.hypot(NARROW[0], room / CELL)), *NARROW[1:])
        smooth = (1 - FAR) * self._smoothed(histogram, narrow) + FAR * self._smoothed(histogram, WIDE)
        doubt = max(doubt, 1e-3)
        density = self._looked_up(smooth) + np.float32(doubt) * np.exp(self.anything)
        return np.asarray(np.log(density / np.float32(weights.sum() + doubt) + 1e-12), np.float32)

    def _histogram(self, weights: FloatArray) -> FloatArray:
        teaching = np.flatnonzero(weights > 0)
        parts = self._share[:, teaching] * weights[teaching]
        index = self._index[:, teaching]
        counted = np.bincount(index.reshape(-1), parts.reshape(-1), int(np.prod(self._shape)))
        return counted.reshape(self._shape).astype(np.float32)

    def _looked_up(self, histogram: FloatArray) -> FloatArray:
        flat = histogram.reshape(-1)
        found = np.zeros(self._index.shape[1], np.float32)
        for index, share in zip(self._index, self._share, strict=True):
            found += share * flat[index]
        return found

    def _smoothed(self, histogram: FloatArray, sigmas: tuple[float, ...]) -> FloatArray:
        import cv2

        for axis, sigma in enumerate(sigmas[: histogram.ndim]):
            reach = np.arange(-np.ceil(3 * sigma), np.ceil(3 * sigma) + 1)
            kernel = np.exp(-np.square(reach / sigma) / 2).astype(np.float32)
            turned = np.ascontiguousarray(np.moveaxis(histogram, axis, 0))
            rows = turned.reshape(len(turned), -1)
            blurred = cv2.filter2D(rows, cv2.CV_32F, kernel[:, None] / kernel.sum(), borderType=cv2.BORDER_CONSTANT)
            histogram = np.moveaxis(np.asarray(blurred, np.float32).reshape(turned.shape), 0, axis)
        return np.ascontiguousarray(histogram)


def _place(flat: FloatArray) -> NDArray[np.float32]:
    """Features (n, D) in bins: (n, 3) of color, or (n, 4) with texture, within the limits of both."""
    color = np.clip(flat[:, :3], -COLORS, COLORS)
    bent = np.arcsinh(color[:, 1:] / BEND) * BEND
    axes = [color[:, 0] / CELL, *(bent / CELL).T]
    if flat.shape[1] > 3:
        texture = flat[:, 3 : 3 + RESPONSES] / np.asarray(TEXTURE_WEIGHTS[:RESPONSES], np.float32)
        axes.append(np.clip(texture.mean(axis=1), 0, TEXTURES) / TEXTURE_CELL)
    return np.stack(axes, axis=1).astype(np.float32)
