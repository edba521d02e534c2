"""Probabilities and their logarithms, in float32 and without overflow."""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray


def sigmoid(x: FloatArray) -> FloatArray:
    """1 / (1 + exp(-x)), with x clamped to ±60."""
    return np.asarray(1 / (1 + np.exp(-np.clip(x, -60, 60))), np.float32)


def log_sum_exp(scores: FloatArray) -> FloatArray:
    """log of the sum of exponentials over the last axis, which is kept."""
    top = scores[..., :1]
    for k in range(1, scores.shape[-1]):
        top = np.maximum(top, scores[..., k : k + 1])  # several times faster than `max` over so short an axis
    total = np.exp(scores - top) @ np.ones((scores.shape[-1], 1), scores.dtype)
    return np.asarray(top + np.log(total), np.float32)


def log_softmax(scores: FloatArray) -> FloatArray:
    """Scores shifted so that their exponentials sum to 1 over the last axis."""
    return scores - log_sum_exp(scores)


def softmax(scores: FloatArray) -> FloatArray:
    """Probabilities in proportion to the exponentials of the scores; they sum to 1 over the last axis.

    >>> softmax(np.log(np.float32([1, 3]))).round(3).tolist()
    [0.25, 0.75]
    """
    return np.asarray(np.exp(log_softmax(scores)), np.float32)
