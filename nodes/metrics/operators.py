"""Figures as operators: what `graphface ablate` measures with, and what a graph may wire.

The same functions as in `pictures` and `geometry`; pictures of either encoding are compared in the truth's.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes import metrics
from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.types import Albedo, Direction, FloatArray, Image, Judgements, Landmarks, Mask, Normals, Shading

Comparable = Image | Albedo | Shading


@node("metrics.psnr")
def psnr(result: Comparable, truth: Comparable, mask: Mask | None = None) -> float:
    """PSNR in dB, at most 120; higher is better."""
    return metrics.psnr(*_arrays(result, truth), mask)


@node("metrics.si_psnr")
def si_psnr(result: Comparable, truth: Comparable, mask: Mask | None = None) -> float:
    """PSNR in dB after the best gain; higher is better."""
    return metrics.si_psnr(*_arrays(result, truth), mask)


@node("metrics.ssim")
def ssim(result: Comparable, truth: Comparable, mask: Mask | None = None) -> float:
    """Structural similarity (Wang et al. 2004), at most 1; higher is better."""
    return metrics.ssim(*_arrays(result, truth), mask)


@node("metrics.ms_ssim")
def ms_ssim(result: Comparable, truth: Comparable, mask: Mask | None = None) -> float:
    """Multi-scale structural similarity (Wang et al. 2003), at most 1; higher is better."""
    return metrics.ms_ssim(*_arrays(result, truth), mask)


@node("metrics.dssim")
def dssim(result: Comparable, truth: Comparable, mask: Mask | None = None) -> float:
    """Structural dissimilarity, (1 - SSIM) / 2, 0 to 1; lower is better."""
    return (1 - metrics.ssim(*_arrays(result, truth), mask)) / 2


@node("metrics.si_mse")
def si_mse(result: Comparable, truth: Comparable, mask: Mask | None = None) -> float:
    """Squared error after the best gain over the power of the truth; lower is better."""
    return metrics.si_mse(*_arrays(result, truth), mask)


@node("metrics.lmse")
def lmse(result: Comparable, truth: Comparable, mask: Mask | None = None) -> float:
    """Local mean squared error (Grosse et al. 2009); lower is better."""
    return metrics.lmse(*_arrays(result, truth), mask)


@node("metrics.whdr")
def whdr(albedo: Albedo, judgements: Judgements, *, delta: Annotated[float, Field(gt=0, le=1)] = 0.1) -> float:
    """Weighted human disagreement rate (Bell, Bala, Snavely 2014), 0 to 1; lower is better."""
    return metrics.whdr(albedo, judgements.pairs, delta=delta)


@node("metrics.normal_angle")
def normal_angle(result: Normals, truth: Normals, mask: Mask | None = None) -> float:
    """Mean angle between normals in degrees; lower is better."""
    return metrics.mean_angle(result, truth, mask)


@node("metrics.light_angle")
def light_angle(result: Direction, truth: Direction) -> float:
    """Angle between two light directions in degrees; lower is better."""
    return metrics.direction_angle(result, truth)


@node("metrics.iou")
def iou(result: Mask, truth: Mask) -> float:
    """Intersection over union of soft masks; higher is better."""
    return metrics.iou(result, truth)


@node("metrics.landmark_error")
def landmark_error(result: Landmarks, truth: Landmarks) -> float:
    """Mean distance over the inter-ocular distance; lower is better."""
    return metrics.landmark_error(result, truth)


def _arrays(result: Image | FloatArray, truth: Image | FloatArray) -> tuple[FloatArray, FloatArray]:
    """Both as arrays of one size and encoding.

    Raises:
        ValueError: their sizes differ.
    """
    if isinstance(result, Image) and isinstance(truth, Image) and result.encoding != truth.encoding:
        result = (encode_srgb if truth.encoding == "srgb" else decode_srgb)(result.pixels)
    one, other = (value.pixels if isinstance(value, Image) else value for value in (result, truth))
    if one.shape != other.shape:
        raise ValueError(f"the result is {one.shape} and the truth {other.shape}; figures need one size")
    return one, other
