"""Where there is skin, on the face and around it: a cheap answer for graphs that do without the full segmentation."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.makeup.features import Features
from graphface.nodes.types import FloatArray, Image, Landmarks, Mask, Surface

_NOISE = 0.02


@node("makeup.skin")
def skin(
    photo: Image,
    surface: Surface,
    landmarks: Landmarks,
    features: Features,
    given: Mask | None = None,
    *,
    spread: Annotated[float, Field(gt=0, le=20)] = 3.5,
    resolution: Annotated[int, Field(ge=16, le=256)] = 64,
) -> Mask:
    """Skin of the face, ears and neck: pixels coloured like the face, connected with the face, not far from it.

    Args:
        given: a segmentation's face label, or a user's mask; it is returned as it is.
        spread: deviations from the face's colour at which a pixel is half skin.
        resolution: pixels per inter-ocular distance of the copy that is decided on; edges then follow the photo.
    """
    import cv2

    if given is not None:
        return given
    unit = max(landmarks.interocular, 1e-3)
    scale = min(1.0, resolution / unit)
    height, width = (max(1, round(n * scale)) for n in surface.coverage.shape)

    def small(values: FloatArray) -> FloatArray:
        return np.asarray(cv2.resize(values, (width, height), interpolation=cv2.INTER_AREA), np.float32)

    covered = small(surface.coverage)
    colours = _log_opponent(small(photo.pixels))
    parts = (features.eyes, features.mouth, features.lips, features.lids, features.brows)
    deep = _deep(covered, unit * scale)
    sample = (deep > 0.5) & (small(np.maximum.reduce(parts)) < 0.1)
    if sample.sum() < 12:
        warn("makeup.skin: too few pixels of bare skin to learn the skin's colour; the mesh alone decides")
        return surface.coverage
    apart = _mahalanobis(colours, colours[sample])
    like = 1 / (1 + np.exp(np.clip(2 * (apart - spread), -30, 30)))
    facial = np.maximum(deep, np.minimum(2 * small(np.maximum.reduce(parts)), 1))
    likely = np.where(covered > 0.5, np.maximum(_closed(like, 0.1 * unit * scale), facial), like)
    likely = cv2.GaussianBlur(likely.astype(np.float32), (0, 0), max(0.03 * unit * scale, 0.5))
    likely *= _near(covered > 0.5, unit * scale)
    connected = _connected(likely > 0.5, covered > 0.5)
    soft = cv2.GaussianBlur((likely * connected).astype(np.float32), (0, 0), max(0.02 * unit * scale, 0.5))
    full = cv2.resize(soft, (surface.coverage.shape[1], surface.coverage.shape[0]), interpolation=cv2.INTER_LINEAR)
    guided = _guided(full, photo.pixels.mean(axis=2), max(1, round(0.03 * unit)))
    return np.asarray(np.clip((guided - 0.2) / 0.6, 0, 1), np.float32)


def _log_opponent(pixels: FloatArray) -> FloatArray:
    """(log intensity / 3, log R/G, log B/G): light moves the first alone, and it counts least."""
    logs = np.log(np.maximum(pixels, 0) + np.float32(0.04))
    return np.dstack([logs.mean(axis=2) / 3, logs[..., 0] - logs[..., 1], logs[..., 2] - logs[..., 1]])


def _mahalanobis(colours: FloatArray, sample: FloatArray) -> FloatArray:
    """Distance of every pixel from the sample's median colour, in its deviations (ridged by the sensor's noise)."""
    middle = np.median(sample, axis=0)
    spread = sample.astype(np.float64) - middle
    spread = spread[np.linalg.norm(spread, axis=1) <= np.quantile(np.linalg.norm(spread, axis=1), 0.9)]
    covariance = spread.T @ spread / max(len(spread), 1) + _NOISE**2 * np.eye(3)
    offset = (colours - middle).astype(np.float64)
    squared = np.einsum("hwi,ij,hwj->hw", offset, np.linalg.inv(covariance), offset)
    return np.asarray(np.sqrt(np.maximum(squared, 0)), np.float32)


def _deep(covered: FloatArray, unit: float) -> FloatArray:
    """1 deep inside the mesh, whatever is painted there, falling to 0 over the outer rim, where hair may hang."""
    import cv2

    depth = cv2.distanceTransform((covered > 0.5).astype(np.uint8), cv2.DIST_L2, 5) / max(unit, 1e-3)
    return np.asarray(np.clip((depth - 0.12) / 0.12, 0, 1), np.float32)


def _closed(like: FloatArray, radius: float) -> FloatArray:
    """Thin gaps filled: a stripe of paint is narrower than what hangs into a face."""
    import cv2

    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * max(1, round(radius)) + 1,) * 2)
    return np.asarray(cv2.morphologyEx(like.astype(np.float32), cv2.MORPH_CLOSE, kernel), np.float32)


def _near(face: NDArray[np.bool_], unit: float) -> FloatArray:
    """1 at the face, 0 further than 1.5 inter-ocular distances away."""
    import cv2

    distance = cv2.distanceTransform((~face).astype(np.uint8), cv2.DIST_L2, 5) / max(unit, 1e-3)
    return np.asarray(np.clip((1.5 - distance) * 2, 0, 1), np.float32)


def _connected(likely: NDArray[np.bool_], face: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The parts that touch the face."""
    import cv2

    _, label = cv2.connectedComponents(likely.astype(np.uint8), connectivity=4)
    touching = np.unique(label[face & likely])
    connected: NDArray[np.bool_] = np.isin(label, touching[touching > 0])
    return connected


def _guided(mask: FloatArray, guide: FloatArray, radius: int, epsilon: float = 1e-3) -> FloatArray:
    """He, Sun, Tang, Guided Image Filtering, ECCV 2010: the mask's edges move onto the photo's."""
    import cv2

    def mean(values: FloatArray) -> FloatArray:
        return np.asarray(cv2.blur(values, (2 * radius + 1, 2 * radius + 1)), np.float32)

    g, m = mean(guide), mean(mask)
    slope = (mean(guide * mask) - g * m) / (np.maximum(mean(guide * guide) - g * g, 0) + np.float32(epsilon))
    return mean(slope) * guide + mean(m - slope * g)
