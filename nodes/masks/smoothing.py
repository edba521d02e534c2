"""Spatial smoothing of labels: neighboring pixels of similar color have similar labels. Three interchangeable ways."""

from __future__ import annotations

from typing import Literal

import numpy as np

from graphface.nodes.masks.logits import log_softmax, softmax
from graphface.nodes.types import FloatArray

Smoothing = Literal["none", "guided", "mean_field"]


STEPS = (1, 2, 4)
"""Distances of the neighbors in each of eight directions, pixels."""


def smoothed(scores: FloatArray, pixels: FloatArray, *, method: Smoothing) -> FloatArray:
    """Unnormalized log-probabilities h x w x C to smoothed probabilities that sum to 1.

    Args:
        pixels: h x w x 3 sRGB, the picture whose edges are kept.
        method: "none", "guided" (guided filter) or "mean_field" (see `mean_field`).
    """
    if method == "none":
        return softmax(scores)
    return _guided(softmax(scores), pixels) if method == "guided" else mean_field(log_softmax(scores), pixels)


def _guided(probabilities: FloatArray, pixels: FloatArray, radius: int = 4, ridge: float = 1e-3) -> FloatArray:
    """Each probability through the guided filter (He, Sun and Tang, ECCV 2010)."""
    import cv2

    guide = np.clip(np.nan_to_num(pixels), 0, 1).astype(np.float32, copy=False)
    maps = [np.ascontiguousarray(p) for p in np.moveaxis(probabilities, 2, 0)]
    filtered = np.stack([cv2.ximgproc.guidedFilter(guide, p, radius, ridge) for p in maps], axis=2)
    filtered = np.clip(np.nan_to_num(filtered), 1e-6, 1)
    return np.asarray(filtered / filtered.sum(axis=2, keepdims=True), np.float32)


def mean_field(
    scores: FloatArray, pixels: FloatArray, *, strength: float = 2.5, contrast: float = 0.08, rounds: int = 5
) -> FloatArray:
    """Mean-field inference in a contrast-sensitive Potts model (Krähenbühl and Koltun 2011, with few neighbors).

    Args:
        scores: log-probabilities. strength: what all neighbors together can add to a label's score.
        contrast: RGB distance at which a neighbor's weight has fallen to exp(-1/2).
    """
    clean = np.clip(np.nan_to_num(pixels), 0, 1).astype(np.float32, copy=False)
    offsets = [(a * s, b * s) for s in STEPS for a, b in ((0, 1), (1, 0), (1, 1), (1, -1))]
    pairs = []
    for down, right in offsets:
        here, there = _overlap(scores.shape, down, right)
        if here is None:
            continue
        away = np.square(clean[here] - clean[there]).sum(axis=2, keepdims=True)
        pairs.append((here, there, np.exp(-away / (2 * contrast**2)) / np.hypot(down, right)))
    total = 2 * sum(1 / np.hypot(*offset) for offset in offsets)
    probabilities = softmax(scores)
    for _ in range(rounds):
        support = np.zeros_like(scores)
        for here, there, weight in pairs:
            support[here] += weight * probabilities[there]
            support[there] += weight * probabilities[here]
        probabilities = softmax(scores + np.float32(strength / total) * support)
    return probabilities


def _overlap(shape: tuple[int, ...], down: int, right: int) -> tuple[tuple[slice, slice] | None, tuple[slice, slice]]:
    """The parts of a grid where a pixel and its neighbor at this offset both lie inside; None where there are none."""
    height, width = shape[:2]
    if down >= height or abs(right) >= width:
        return None, (slice(0), slice(0))
    rows = slice(0, height - down), slice(down, height)
    columns = (slice(0, width - right), slice(right, width)) if right >= 0 else (slice(-right, width), slice(0, right))
    return (rows[0], columns[0]), (rows[1], columns[1])
