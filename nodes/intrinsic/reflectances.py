"""The few reflectances of `intrinsic.bell2014`: clusters of color, with intensities that make shading continuous."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

_INTENSITY_WEIGHT = 0.5
"""Of log intensity beside chromaticity in clustering, as in Bell et al., because shading changes it."""


_REWEIGHTINGS = 10


_LEAST_RESIDUAL = 0.02
"""Of log intensity, in the weights of an L1 fit."""


_RIDGE = 1e-3


@dataclass(frozen=True)
class Palette:
    """`label` intp H x W, the reflectance of each pixel; `intensities` float32 (k,), the logarithms of k reflectances;
    `hues` float32 (k, 3), their chromaticities."""

    label: NDArray[np.intp]
    intensities: FloatArray
    hues: FloatArray


def clusters(intensity: FloatArray, hue: FloatArray, count: int) -> Palette:
    """k-means of colors, initialized by quantiles of intensity instead of random numbers, so every run is the same.

    Args:
        intensity: logarithmic, H x W. hue: chromaticity, H x W x 3. count: at most so many clusters.
    """
    import cv2

    points = np.concatenate([_INTENSITY_WEIGHT * intensity[..., None], 3 * hue], axis=2).reshape(-1, 4)
    points = points.astype(np.float32)
    count = min(count, len(points))
    if count < 2:
        return Palette(np.zeros(intensity.shape, np.intp), intensity.reshape(-1)[:1], hue.reshape(-1, 3)[:1])
    rank = np.argsort(np.argsort(points[:, 0], kind="stable"), kind="stable")
    start = (rank * count // len(points)).astype(np.int32)
    criteria = (cv2.TERM_CRITERIA_MAX_ITER + cv2.TERM_CRITERIA_EPS, 15, 1e-4)
    _, label, centers = cv2.kmeans(points, count, start[:, None], criteria, 1, cv2.KMEANS_USE_INITIAL_LABELS)
    centers = np.asarray(centers, np.float32)
    label = np.asarray(label, np.intp).reshape(intensity.shape)
    return Palette(label, centers[:, 0] / np.float32(_INTENSITY_WEIGHT), centers[:, 1:] / np.float32(3))


def with_continuous_shading(palette: Palette, label: NDArray[np.intp], intensity: FloatArray) -> Palette:
    """The palette with new labels and intensities r = argmin sum |(L_i - r_i) - (L_j - r_j)|.

    The sum is over neighbouring pixels i, j of different labels; L is the log intensity. An L1 fit by iteratively
    reweighted least squares. A ridge keeps the mean, and the intensities of labels without a border.
    """
    count = len(palette.intensities)
    here, there, step = _label_borders(label, intensity)
    r = palette.intensities.astype(np.float64)
    pair = here * count + there
    for _ in range(_REWEIGHTINGS if len(step) else 0):
        weight = 1 / np.maximum(np.abs(step - (r[there] - r[here])), _LEAST_RESIDUAL)
        adjacency = np.bincount(pair, weight, count * count).reshape(count, count)
        right = np.bincount(there, weight * step, count) - np.bincount(here, weight * step, count)
        adjacency = adjacency + adjacency.T
        degree = adjacency.sum(axis=1)
        ridge = _RIDGE * max(float(degree.mean()), 1e-9)
        r = np.linalg.solve(np.diag(degree + ridge) - adjacency, right + ridge * palette.intensities)
    return replace(palette, label=label, intensities=r.astype(np.float32))


def _label_borders(
    label: NDArray[np.intp], intensity: FloatArray
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64]]:
    """Labels on both sides of each border between neighbouring pixels, and the step of log intensity across it."""
    parts = []
    for one, other in ((np.s_[:-1], np.s_[1:]), (np.s_[:, :-1], np.s_[:, 1:])):
        differ = label[one] != label[other]
        parts.append((label[one][differ], label[other][differ], (intensity[other] - intensity[one])[differ]))
    here, there, step = (np.concatenate(part) for part in zip(*parts, strict=True))
    return here, there, step.astype(np.float64)
