"""Intrinsic Images in the Wild: few reflectances, spread by a fully connected random field."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.intrinsic.lift import lifted, shrunk
from graphface.nodes.intrinsic.logarithm import chromaticity, finite_pixels, log_intensity, separated
from graphface.nodes.intrinsic.permutohedral import Lattice
from graphface.nodes.intrinsic.reflectances import clusters, settled
from graphface.nodes.types import FloatArray, Image, Intrinsic, Mask

PLACE, INTENSITY, COLOR = 0.1, 0.12, 0.025
"""The paper's theta_p (of the diagonal), theta_l and theta_c: how near, how alike in log intensity, how alike in
chromaticity two pixels are that are asked to share a reflectance."""


_ALIKE, _SMOOTH, _HUE = 20.0, 4.0, 30.0
"""Weights of the three terms: shared reflectance, smooth shading, hue of the label. Set on the synthetic patchwork of
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
    """Every pixel gets one of a few reflectances; shading is what is left.

    Bell, Bala, Snavely, Intrinsic Images in the Wild, SIGGRAPH 2014. Rounds of two steps: (1) labels by mean-field
    inference in a dense conditional random field, whose pairwise term asks near, similar pixels for like reflectances
    (a five-dimensional Gaussian, `Lattice`) and whose unary terms ask for a shading near the last round's blurred one
    and for the label's hue; (2) the intensities of the reflectances, such that shading is continuous across the
    borders between labels. (The paper's constant prior on shading is taken over by the overall scale, its final
    splitting of labels is left out.)

    Args:
        mask: H x W, over which shading gets the mean of the intensity.
        labels: how many reflectances. rounds: of both steps. sweeps: of mean-field inference in a round.
        resolution: longer side of the copy that is solved on. Draft: rounds 3, sweeps 2, resolution 160.
        floor: least shading.

    Returns:
        albedo * shading is the photo.
    """
    pixels = finite_pixels(photo, "intrinsic.bell2014")
    tiny = shrunk(pixels, resolution)
    intensity, hue = log_intensity(tiny), chromaticity(tiny)
    palette = clusters(intensity, hue, labels)
    lattice = Lattice(_features(intensity, hue))
    own = hue.reshape(-1, 3)[:, None, :] - palette.hues[None]
    off_hue = np.float32(_HUE) * np.sqrt(np.einsum("nkc,nkc->nk", own, own))
    expected = _blurred(intensity - palette.intensities[palette.label])
    belief: FloatArray | None = None
    for _ in range(rounds):
        shading = intensity.reshape(-1, 1) - palette.intensities[None, :]
        unary = off_hue + np.float32(_SMOOTH) * np.abs(shading - expected.reshape(-1, 1))
        contrast = np.abs(palette.intensities[:, None] - palette.intensities[None, :])
        belief = _mean_field(unary, contrast, lattice, sweeps, belief)
        palette = settled(palette, belief.argmax(axis=1).reshape(intensity.shape), intensity)
        expected = _blurred(intensity - palette.intensities[palette.label])
    assert belief is not None
    reflectance = (belief @ palette.intensities).reshape(intensity.shape)
    return separated(pixels, lifted(intensity - reflectance, intensity, log_intensity(pixels)), mask, floor)


def _features(intensity: FloatArray, hue: FloatArray) -> NDArray[np.float32]:
    """(n, 5): place, log intensity and two chromaticities, each over its standard deviation."""
    height, width = intensity.shape
    reach = max(PLACE * float(np.hypot(height, width)), 1e-3)
    rows, columns = np.mgrid[0:height, 0:width].astype(np.float32) / np.float32(reach)
    channels = [rows, columns, intensity / np.float32(INTENSITY), hue[..., 0] / COLOR, hue[..., 1] / COLOR]
    return np.stack([np.asarray(c, np.float32).ravel() for c in channels], axis=1)


def _mean_field(
    unary: FloatArray, contrast: FloatArray, lattice: Lattice, sweeps: int, belief: FloatArray | None
) -> FloatArray:
    """Probabilities (n, labels). Krähenbühl and Koltun, NIPS 2011: a sweep is one filtering and one small product."""
    belief = _softmax(-unary) if belief is None else belief
    for _ in range(sweeps):
        belief = _softmax(-unary - np.float32(_ALIKE) * (lattice.filter(belief) @ contrast))
    return belief


def _softmax(scores: FloatArray) -> FloatArray:
    powers = np.exp(scores - scores.max(axis=1, keepdims=True))
    probabilities: FloatArray = powers / powers.sum(axis=1, keepdims=True)
    return probabilities


def _blurred(shading: FloatArray) -> FloatArray:
    import cv2

    sigma = max(PLACE * 0.5 * max(shading.shape), 0.5)
    return np.asarray(cv2.GaussianBlur(shading, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE), np.float32)
