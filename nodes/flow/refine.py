"""A correspondence refined by optical flow, where the flow can be trusted.

The reference, warped by the correspondence of the meshes, and the input show the same face in different makeup. What
should match is the edges of eyes, brows, nostrils and lips, not their colors. So both are reduced to the logarithm of
intensity, normalized to zero local mean and unit local contrast. Flow is computed in both directions. Its confidence is
0 where the directions disagree, where the pictures still do not match after the displacement, or where there is nothing
to match. Normalized convolution (Knutsson and Westin, CVPR 1993) with a prior of no displacement turns the confident
displacements into a smooth field; without any confidence the meshes decide.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.blur import gaussian
from graphface.nodes.bounding_box import Box, bounding_box
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import face_scale
from graphface.nodes.resample import resampled
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Correspondence, FloatArray, Image, Landmarks

GreyPicture = NDArray[np.uint8]
"""H x W."""


Flow = Callable[[GreyPicture, GreyPicture], Any]
"""(source, target) to displacements H x W x 2 in pixels: target[x + flow(x)] looks like source[x]."""


Length = Annotated[float, Field(gt=0, le=2)]


Resolution = Annotated[int, Field(ge=16, le=400)]


_PARAMETERS = """

Args:
    photo, reference: the input and the reference, each in its own pixels.
    correspondence: of the meshes, from input pixels to positions in the reference.
    landmarks: the input's.
    resolution: pixels per inter-ocular distance of the copies between which flow is computed.
    smoothing: sigma of the Gaussian that makes the field smooth, in inter-ocular distances.
    tolerance: disagreement of the two directions at which confidence is 1/e, in inter-ocular distances.
    reach: longest displacement, in inter-ocular distances; a longer one is taken for a mistake.

Returns:
    The correspondence with places (and mirrored places) moved; the same object if the face is less than 8 pixels
    between the eyes, with a warning, or outside of the picture.
"""


_LEAST_INTEROCULAR = 8
"""Pixels."""


_INTENSITY_FLOOR = np.float32(0.05)
"""Added to intensity before the logarithm: differences in the dark are noise."""


_CONTRAST_WINDOW = 0.1
"""Sigma of the Gaussian that local mean and contrast are taken over, in inter-ocular distances."""


_CONTRAST_FLOOR = 0.02


_GREY_LEVELS = 45.0
"""Grey levels of one standard deviation of local contrast."""


_MATCH_WINDOW = 0.04
"""Sigma of the Gaussian that two pictures are compared over, in inter-ocular distances."""


_LEAST_MIRRORED_SHARE = 0.02
"""Share of the face that only the mirror image shows from which on the mirror image is matched, too."""


_RESAMPLING_ERROR = np.float32(0.02)
"""Mean squared difference of two copies of one picture, one of which was resampled: no reason to move."""


_LEAST_SIDE = 8
"""Of the copies that are compared, in pixels: smaller pictures have no flow."""


_PRIOR_WEIGHT = 0.15
"""Weight of the prior, no displacement; a fully confident pixel has 1."""


def flow_operator(name: str, *, resolution: int) -> Callable[[Flow], Callable[..., Correspondence]]:
    """Declare a method of optical flow as the operator `name` that refines a correspondence.

    The decorated function becomes the operator, with the ports and parameters that `_PARAMETERS` describes; its
    docstring, the paper, begins the operator's.

    Args:
        resolution: default of that parameter.
    """
    default = resolution

    def declare(flow: Flow) -> Callable[..., Correspondence]:
        def operator(
            photo: Image,
            reference: Image,
            correspondence: Correspondence,
            landmarks: Landmarks,
            *,
            resolution: Resolution = default,
            smoothing: Length = 0.1,
            tolerance: Length = 0.03,
            reach: Length = 0.15,
        ) -> Correspondence:
            settings = Settings(resolution, smoothing, tolerance, reach)
            return refined(photo, reference, correspondence, landmarks, flow, settings)

        operator.__name__ = operator.__qualname__ = flow.__name__
        operator.__doc__ = (flow.__doc__ or "") + _PARAMETERS
        return node(name)(operator)

    return declare


@dataclass(frozen=True)
class Settings:
    """The parameters of a flow operator; lengths in inter-ocular distances."""

    resolution: int
    smoothing: float
    tolerance: float
    reach: float


def refined(
    photo: Image,
    reference: Image,
    correspondence: Correspondence,
    landmarks: Landmarks,
    flow: Flow,
    settings: Settings,
) -> Correspondence:
    """The correspondence, moved by a flow where that makes the two faces match.

    The mirror image, which stands in for what the reference hides, is another picture of the face and is matched apart.
    """
    margin = 0.1 * landmarks.interocular
    if landmarks.interocular < _LEAST_INTEROCULAR:
        warn(f"flow: eyes are {landmarks.interocular:.1f} pixels apart, too few to match anything; the meshes decide")
        return correspondence
    box = bounding_box(correspondence.inside, margin=round(margin))
    if box is None:
        return correspondence

    def moved(places: FloatArray, valid: FloatArray, box: Box) -> FloatArray:
        direct = replace(correspondence, places=places, valid=valid, mirrored=None, mirrored_valid=None)
        return _refined_places(photo, reference, direct, box, landmarks, flow, settings)

    places = moved(correspondence.places, correspondence.valid, box)
    mirrored, valid = correspondence.mirrored, correspondence.mirrored_valid
    if mirrored is not None and valid is not None:
        shown = valid > 0.5
        if shown.mean() > _LEAST_MIRRORED_SHARE * correspondence.inside.mean():
            mirrored = moved(mirrored, valid, bounding_box(shown, margin=round(margin)) or box)
    return replace(correspondence, places=places, mirrored=mirrored)


def _refined_places(
    photo: Image,
    reference: Image,
    correspondence: Correspondence,
    box: Box,
    landmarks: Landmarks,
    flow: Flow,
    settings: Settings,
) -> FloatArray:
    """The places H x W x 2, moved within the box."""
    size = correspondence.inside[box].shape
    copy = face_scale(landmarks, size, settings.resolution, least=_LEAST_SIDE)
    unit = copy.interocular
    inside = copy.down((correspondence.inside * (correspondence.valid > 0.5))[box])
    inside *= inside > 0.999  # beside the mesh there is nothing to compare
    on_copy = replace(correspondence, places=copy.down(correspondence.places[box]), inside=inside, valid=inside)
    own = _log_intensity(copy.down(photo.pixels[box]))
    warped = np.where(inside > 0.999, _log_intensity(resampled(reference.pixels, on_copy)), own)
    own, warped = (_normalized(values, _CONTRAST_WINDOW * unit) for values in (own, warped))
    grey, grey_warped = (np.clip(128 + _GREY_LEVELS * v, 0, 255).astype(np.uint8) for v in (own, warped))
    forward = np.asarray(flow(grey, grey_warped), np.float32)
    backward = np.asarray(flow(grey_warped, grey), np.float32)

    matched = _displaced(warped, forward)
    confidence = inside * _agreement(forward, backward, settings.tolerance * unit)
    confidence *= _correlation(own, matched, _MATCH_WINDOW * unit)
    confidence *= _improvement(own, warped, matched, _MATCH_WINDOW * unit)
    confidence *= np.hypot(forward[..., 0], forward[..., 1]) < settings.reach * unit
    confidence = np.nan_to_num(confidence)
    field = gaussian(np.nan_to_num(forward) * confidence[..., None], settings.smoothing * unit)
    field /= (gaussian(confidence, settings.smoothing * unit) + _PRIOR_WEIGHT)[..., None]
    pixels_per_step = np.array([size[1] / copy.size[1], size[0] / copy.size[0]], np.float32)
    return _moved(correspondence, box, copy.up(field * pixels_per_step))


def _moved(correspondence: Correspondence, box: Box, displacement: FloatArray) -> FloatArray:
    """places(x + displacement(x)) within the box; where that leaves the mesh, places(x)."""
    places = correspondence.places.copy()
    inside = correspondence.inside[box]
    before = np.dstack([places[box] * inside[..., None], inside])
    into = places[box]

    def strip(rows: slice) -> None:
        moved = _displaced(before, displacement[rows], rows.start)
        on_mesh = moved[..., 2] > 0.999
        into[rows][on_mesh] = moved[on_mesh, :2]

    by_strips(strip, before.shape)
    return places


def _log_intensity(pixels: FloatArray) -> FloatArray:
    return np.asarray(np.log(np.maximum(channel_mean(pixels), 0) + _INTENSITY_FLOOR), np.float32)


def _normalized(values: FloatArray, sigma: float) -> FloatArray:
    """Zero local mean and unit local standard deviation; flat areas stay flat."""
    fine = values - gaussian(values, sigma)
    contrast = np.sqrt(np.maximum(gaussian(fine * fine, sigma), 0) + np.float32(_CONTRAST_FLOOR**2))
    return np.asarray(fine / contrast, np.float32)


def _agreement(forward: FloatArray, backward: FloatArray, tolerance: float) -> FloatArray:
    """exp(-(e / tolerance)^2) for the distance e between a pixel and where forward, then backward flow takes it."""
    error = forward + _displaced(backward, forward)
    relative = np.hypot(error[..., 0], error[..., 1]) / max(tolerance, 1e-6)
    return np.asarray(np.exp(-np.square(np.minimum(relative, 10))), np.float32)


def _correlation(one: FloatArray, other: FloatArray, sigma: float) -> FloatArray:
    """Local correlation of two pictures, as a ramp from 0 at 0.3 to 1 at 0.8; 0 where both are flat."""
    covariance = gaussian(one * other, sigma)
    power = np.maximum(gaussian(one * one, sigma) * gaussian(other * other, sigma), 0) + np.float32(0.05)
    return np.asarray(np.clip((covariance / np.sqrt(power) - np.float32(0.3)) * 2, 0, 1), np.float32)


def _improvement(own: FloatArray, before: FloatArray, after: FloatArray, sigma: float) -> FloatArray:
    """1 where the displacement halves the local squared difference of the pictures, 0 where it does not reduce it."""
    error_before, error_after = (gaussian(np.square(own - warped), sigma) for warped in (before, after))
    gained = error_before - error_after - _RESAMPLING_ERROR
    return np.asarray(np.clip(2 * gained / (error_before + np.float32(0.02)), 0, 1), np.float32)


def _displaced(values: FloatArray, flow: FloatArray, top: int = 0) -> FloatArray:
    """values(x + flow(x)), for the rows of `values` from `top` on that `flow` is given for."""
    import cv2

    positions = flow + np.array([0, top], np.float32)
    positions[..., 0] += np.arange(flow.shape[1], dtype=np.float32)
    positions[..., 1] += np.arange(flow.shape[0], dtype=np.float32)[:, None]
    remapped = cv2.remap(values, positions, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)  # type: ignore[call-overload]
    return np.asarray(remapped, np.float32)
