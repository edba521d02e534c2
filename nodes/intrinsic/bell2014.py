"""Intrinsic Images in the Wild: few reflectances, assigned by a fully connected random field."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.intrinsic.guided_upsampling import reduced, upsampled
from graphface.nodes.intrinsic.log_domain import chromaticity, finite_pixels, intrinsic_images, log_intensity
from graphface.nodes.intrinsic.permutohedral import Lattice
from graphface.nodes.intrinsic.reflectances import Palette, clusters, with_continuous_shading
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

THETA_P, THETA_L, THETA_C = 0.1, 0.12, 0.025
"""Standard deviations of the pairwise kernel, named as in the paper: position (share of the diagonal), log intensity
and chromaticity. The pairwise term prefers the same reflectance for pixels that are near in all three."""


_PAIRWISE_WEIGHT, _SHADING_WEIGHT, _HUE_WEIGHT = 20.0, 4.0, 30.0
"""Of the three terms: equal reflectance, smooth shading, hue of the label. Chosen on the synthetic patchwork of
tests/nodes/intrinsic, to within a factor of 2."""


@node("intrinsic.bell2014")
def bell2014(
    photo: Image,
    mask: Mask | None = None,
    *,
    labels: Annotated[int, Field(ge=2, le=64)] = 20,
    rounds: Annotated[int, Field(ge=1, le=50)] = 8,
    sweeps: Annotated[int, Field(ge=1, le=50)] = 4,
    resolution: Annotated[int, Field(ge=16, le=2048)] = 320,
    floor: Annotated[float, Field(gt=0, le=1)] = 0.05,
) -> Intrinsic:
    """Every pixel gets one of a few reflectances; the remainder is shading.

    Bell, Bala, Snavely, Intrinsic Images in the Wild, SIGGRAPH 2014. Two steps alternate. (1) Labels by mean-field
    inference in a dense conditional random field: the pairwise term prefers similar reflectances of near and similar
    pixels (a five-dimensional Gaussian, `Lattice`), the unary terms a shading near the blurred one of the last round
    and a hue near the label's. (2) Intensities of the reflectances that make shading continuous across the borders
    between labels. (The overall scale replaces the paper's constant prior on shading; its final splitting of labels is
    left out.)

    Args:
        mask: H x W; over it shading gets the mean of the intensity.
        labels: number of reflectances.
        rounds: of both steps.
        sweeps: of mean-field inference in a round.
        resolution: longer side in pixels of the copy on which the problem is solved. Draft: rounds 3, sweeps 2,
            resolution 160.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.bell2014")
    small = reduced(pixels, resolution)
    intensity, hue = log_intensity(small), chromaticity(small)
    palette = clusters(intensity, hue, labels)
    lattice = Lattice(_features(intensity, hue))
    hue_cost = _hue_cost(hue, palette)
    probabilities: FloatArray | None = None
    for _ in range(rounds):
        expected = _blurred(intensity - palette.intensities[palette.label])
        shading = intensity.reshape(-1, 1) - palette.intensities[None, :]
        unary = hue_cost + np.float32(_SHADING_WEIGHT) * np.abs(shading - expected.reshape(-1, 1))
        difference = np.abs(palette.intensities[:, None] - palette.intensities[None, :])
        probabilities = _mean_field(unary, difference, lattice, sweeps, probabilities)
        palette = with_continuous_shading(palette, probabilities.argmax(axis=1).reshape(intensity.shape), intensity)
    assert probabilities is not None
    reflectance = (probabilities @ palette.intensities).reshape(intensity.shape)
    return intrinsic_images(pixels, upsampled(intensity - reflectance, intensity, log_intensity(pixels)), mask, floor)


def _features(intensity: FloatArray, hue: FloatArray) -> NDArray[np.float32]:
    """(n, 5): position, log intensity and two chromaticities, each over its standard deviation."""
    height, width = intensity.shape
    sigma = max(THETA_P * float(np.hypot(height, width)), 1e-3)
    rows, columns = np.mgrid[0:height, 0:width].astype(np.float32) / np.float32(sigma)
    channels = [rows, columns, intensity / np.float32(THETA_L), hue[..., 0] / THETA_C, hue[..., 1] / THETA_C]
    return np.stack([np.asarray(c, np.float32).ravel() for c in channels], axis=1)


def _hue_cost(hue: FloatArray, palette: Palette) -> FloatArray:
    """Unary cost of each label by the distance of its chromaticity, (n, labels)."""
    difference = hue.reshape(-1, 3)[:, None, :] - palette.hues[None]
    cost: FloatArray = np.float32(_HUE_WEIGHT) * np.sqrt(np.einsum("nkc,nkc->nk", difference, difference))
    return cost


def _mean_field(
    unary: FloatArray, difference: FloatArray, lattice: Lattice, sweeps: int, probabilities: FloatArray | None
) -> FloatArray:
    """Label probabilities (n, labels) by mean-field inference (Krähenbühl and Koltun, NIPS 2011, algorithm 1).

    Args:
        unary: (n, labels). difference: cost of two labels for similar pixels, (labels, labels).
    """
    probabilities = _softmax(-unary) if probabilities is None else probabilities
    for _ in range(sweeps):
        pairwise = lattice.filter(probabilities) @ difference
        probabilities = _softmax(-unary - np.float32(_PAIRWISE_WEIGHT) * pairwise)
    return probabilities


def _softmax(scores: FloatArray) -> FloatArray:
    powers = np.exp(scores - scores.max(axis=1, keepdims=True))
    probabilities: FloatArray = powers / powers.sum(axis=1, keepdims=True)
    return probabilities


def _blurred(shading: FloatArray) -> FloatArray:
    import cv2

    sigma = max(THETA_P * 0.5 * max(shading.shape), 0.5)
    return np.asarray(cv2.GaussianBlur(shading, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE), np.float32)
