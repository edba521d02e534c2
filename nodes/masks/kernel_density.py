"""Kernel density of a photo's pixels: one soft histogram for each label, smoothed. No iteration, and one solution.

Every training pixel puts a small Gaussian at its color and texture (Parzen, On Estimation of a Probability Density
Function and Mode, 1962). All have the same width, so their sum is a blurred histogram of soft bins: it depends smoothly
on every pixel, and linearly on every weight. Mixtures fitted by expectation maximization (`masks.mixture`) end in one
of several optima. In 2 of 116 portraits noise of a tenth of an 8-bit level led to another optimum, which moved 3 to 6 %
of a label.

Bins have four axes: lightness, two of color, and the strength of texture (the mean of the finer MR8 responses).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.masks.features import TEXTURE_WEIGHTS
from graphface.nodes.types import FloatArray

BIN_WIDTH = 0.03
"""Width of a bin in lightness and color, whose ranges are about 1."""


CHROMA_KNEE = 0.3
"""Chroma above which bins grow wider: few pixels are more colorful, and they differ more from each other."""


TEXTURE_BIN_WIDTH, TEXTURE_RESPONSES = 0.3, 4
"""Width of a texture bin, in units of asinh of amplified responses, and the number of responses that are averaged."""


MAX_COLOR, MAX_TEXTURE = 2.0, 3.0
"""Largest color, of either sign, and largest texture. Values beyond go into the last bin, which limits their number."""


NARROW, WIDE, MARGINAL = (1.0, 1.0, 1.0, 1.0), (5.0, 5.0, 5.0, 2.5), (6.0, 6.0, 6.0, 2.0)
"""Standard deviations of the Gaussians, in bins: of a pixel; of its share `WIDE_SHARE`; of the marginal density."""


WIDE_SHARE = 0.2
"""Share of each pixel's weight in the wide Gaussian, so that a label includes colors a little beyond its samples."""


class KernelDensity:
    """Densities of the features of one photo; see `masks.density.DensityModel`.

    Args:
        values: features h x w x D (see `masks.features.features`); color first, then texture if there is any.
    """

    def __init__(self, values: FloatArray) -> None:
        place = _bin_coordinates(np.nan_to_num(values.reshape(-1, values.shape[-1])))
        low = np.floor(place)
        share = (place - low).astype(np.float32)
        cell = (low - low.min(axis=0)).astype(np.int64)
        self._shape: tuple[int, ...] = tuple(int(n) + 2 for n in cell.max(axis=0))
        strides = np.cumprod((1, *self._shape[:0:-1]))[::-1]
        corners = np.indices((2,) * place.shape[1]).reshape(place.shape[1], -1).T
        first = cell @ strides
        # Each pixel is shared linearly by the 2^axes bins around it.
        self._index = np.stack([first + corner @ strides for corner in corners])
        self._share = np.stack([np.where(corner, share, 1 - share).prod(axis=1) for corner in corners])
        marginal = _blurred(self._histogram(np.ones(len(place), np.float32)), MARGINAL)
        self.log_marginal: FloatArray = np.log(self._at_pixels(marginal) / len(place) + 1e-12)

    def log_density(
        self, weights: FloatArray, *, pseudo_count: float = 0.0, lightness_spread: float = 0.0
    ) -> FloatArray:
        """log p of every pixel's features, float32 (n,), under the kernel density of the weighted pixels.

        Args:
            weights: (n,), at least 0: of each pixel as a training sample.
            pseudo_count: samples from the marginal density that are added. Without samples the density is the marginal.
            lightness_spread: further standard deviation of the Gaussians along lightness.
        """
        histogram = self._histogram(weights)
        narrow = (float(np.hypot(NARROW[0], lightness_spread / BIN_WIDTH)), *NARROW[1:])
        smooth = (1 - WIDE_SHARE) * _blurred(histogram, narrow) + WIDE_SHARE * _blurred(histogram, WIDE)
        pseudo_count = max(pseudo_count, 1e-3)
        density = self._at_pixels(smooth) + np.float32(pseudo_count) * np.exp(self.log_marginal)
        return np.asarray(np.log(density / np.float32(weights.sum() + pseudo_count) + 1e-12), np.float32)

    def _histogram(self, weights: FloatArray) -> FloatArray:
        samples = np.flatnonzero(weights > 0)
        parts = self._share[:, samples] * weights[samples]
        index = self._index[:, samples]
        counted = np.bincount(index.reshape(-1), parts.reshape(-1), int(np.prod(self._shape)))
        return counted.reshape(self._shape).astype(np.float32)

    def _at_pixels(self, histogram: FloatArray) -> FloatArray:
        """The histogram, linearly interpolated at every pixel's features: (n,)."""
        flat = histogram.reshape(-1)
        found = np.zeros(self._index.shape[1], np.float32)
        for index, share in zip(self._index, self._share, strict=True):
            found += share * flat[index]
        return found


def _blurred(histogram: FloatArray, sigmas: tuple[float, ...]) -> FloatArray:
    """The histogram under a separable Gaussian; nothing comes in from outside."""
    import cv2

    for axis, sigma in enumerate(sigmas[: histogram.ndim]):
        reach = np.arange(-np.ceil(3 * sigma), np.ceil(3 * sigma) + 1)
        kernel = np.exp(-np.square(reach / sigma) / 2).astype(np.float32)
        first = np.ascontiguousarray(np.moveaxis(histogram, axis, 0))
        rows = first.reshape(len(first), -1)
        blurred = cv2.filter2D(rows, cv2.CV_32F, kernel[:, None] / kernel.sum(), borderType=cv2.BORDER_CONSTANT)
        histogram = np.moveaxis(np.asarray(blurred, np.float32).reshape(first.shape), 0, axis)
    return np.ascontiguousarray(histogram)


def _bin_coordinates(flat: FloatArray) -> NDArray[np.float32]:
    """Features (n, D) in units of bins: (n, 3) of color, or (n, 4) with texture, within the limits of both."""
    color = np.clip(flat[:, :3], -MAX_COLOR, MAX_COLOR)
    chroma = np.arcsinh(color[:, 1:] / CHROMA_KNEE) * CHROMA_KNEE
    axes = [color[:, 0] / BIN_WIDTH, *(chroma / BIN_WIDTH).T]
    if flat.shape[1] > 3:
        texture = flat[:, 3 : 3 + TEXTURE_RESPONSES] / np.asarray(TEXTURE_WEIGHTS[:TEXTURE_RESPONSES], np.float32)
        axes.append(np.clip(texture.mean(axis=1), 0, MAX_TEXTURE) / TEXTURE_BIN_WIDTH)
    return np.stack(axes, axis=1).astype(np.float32)
