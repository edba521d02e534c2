"""The painted face continued to neck, ears and hairline (paper, "Boundary processing").

The paper shrinks the face's boundary and fills a ring beyond it by mirror mapping of the pixels. Here the change from
the input to the painted face is mirrored, as a factor on the input's pixels. The ring then keeps the input's own
texture, no feature is seen twice, and where painting changes nothing the ring does not change either. Farther out the
factor fades into the average factor of the skin, so that neck and ears take the face's new tone.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.blur import gaussian
from graphface.nodes.color import in_three_channels
from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Features, FloatArray, Image, Landmarks, Mask

_FLOOR = np.float32(0.05)
"""Added to both pictures before the ratio is taken: black stays near black."""


_LARGEST_LOG_FACTOR = 2.0


_NEAR, _AROUND = 0.03, 0.4
"""Sigmas, in inter-ocular distances, of the Gaussians that the factor is smoothed and averaged by."""


_TEXTURE = np.float32(0.08)
"""A pixel that differs by less from its smoothed surroundings is texture, and texture is not amplified."""


@node("makeup.boundary")
def boundary(
    photo: Image,
    painted: Image,
    core: Mask,
    features: Features,
    landmarks: Landmarks,
    *,
    ring: Annotated[float, Field(ge=0, le=2)] = 0.15,
    resolution: Annotated[int, Field(ge=8, le=256)] = 64,
) -> Image:
    """The painted face inside `core`, and beyond it the input times the continued factor, over the whole picture.

    Args:
        photo: the input. painted: valid where `core` is not 0.
        ring: width of the mirrored ring, in inter-ocular distances (the paper's 30 pixels on its photos).
        resolution: pixels per inter-ocular distance of the copy on which the factor is continued.
    """
    if not (core > 0).any():
        return photo
    copy = face_scale(landmarks, core.shape, resolution)
    weight, before = copy.down(core), copy.down(photo.pixels)
    log_factor = np.log(np.maximum(copy.down(painted.pixels), 0) + _FLOOR)
    log_factor -= np.log(np.maximum(before, 0) + _FLOOR)
    known = weight >= min(0.5, float(weight.max()))
    skin = known & (copy.down(features.any_of("eyes", "mouth", "lips", "lids", "brows")) < 0.1)
    skin = skin if skin.any() else known
    log_factor = np.clip(log_factor, -_LARGEST_LOG_FACTOR, _LARGEST_LOG_FACTOR)
    average = _local_average(log_factor, skin, _AROUND * copy.interocular)
    log_factor[known & ~skin] = average[known & ~skin]  # lips and brows are not mirrored into the ring
    factor = copy.up(np.exp(_extrapolated(log_factor, known, average, ring, copy)))
    return _composed(photo, painted, core, features, factor, before, skin, copy)


def _local_average(log_factor: FloatArray, skin: NDArray[np.bool_], sigma: float) -> FloatArray:
    """Gaussian average over the skin near each pixel, h x w x 3; far from the face the median over all skin."""
    import cv2

    median = np.median(log_factor[skin], axis=0).astype(np.float32)
    sums = np.dstack([np.where(skin[..., None], log_factor - median, 0), skin.astype(np.float32)])
    sums = cv2.GaussianBlur(sums, (0, 0), max(sigma, 0.5), borderType=cv2.BORDER_CONSTANT)
    return np.asarray(median + sums[..., :3] / (sums[..., 3:] + np.float32(0.05)), np.float32)


def _extrapolated(
    log_factor: FloatArray, known: NDArray[np.bool_], average: FloatArray, ring: float, copy: FaceScale
) -> FloatArray:
    """The factor where it is known, mirrored at the boundary within the ring, fading into the average beyond it."""
    import cv2

    distance, label = cv2.distanceTransformWithLabels(
        (~known).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    y, x = np.mgrid[: known.shape[0], : known.shape[1]].astype(np.float32)
    position_of_label = np.zeros((int(label.max()) + 1, 2), np.float32)
    position_of_label[label[known]] = np.stack([x[known], y[known]], axis=1)
    nearest = position_of_label[label]
    mirrored = 2 * nearest - np.dstack([x, y])
    values = np.where(known[..., None], log_factor, average)

    def at(positions: FloatArray) -> FloatArray:
        remapped = cv2.remap(values, positions, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)  # type: ignore[call-overload]
        return np.asarray(remapped, np.float32)

    inside = cv2.remap(known.astype(np.float32), mirrored, None, cv2.INTER_LINEAR, borderValue=0)[..., None]  # type: ignore[call-overload]
    reflected = at(mirrored)
    edge = at(nearest)  # where the mirrored position is outside of the face, the nearest pixel's value is used
    reflected = edge + np.clip(inside * 2 - 1, 0, 1) * (reflected - edge)
    joined = np.where(known[..., None], log_factor, reflected)
    near = cv2.GaussianBlur(joined, (0, 0), max(_NEAR * copy.interocular, 0.5))
    t = smoothstep(np.asarray(distance / max(ring * copy.interocular, 1e-3), np.float32))[..., None]
    return np.asarray(near + t * (average - near), np.float32)


def _composed(
    photo: Image,
    painted: Image,
    core: Mask,
    features: Features,
    factor: FloatArray,
    before: FloatArray,
    skin: NDArray[np.bool_],
    copy: FaceScale,
) -> Image:
    """core * painted + (1 - core) * photo changed by the factor; `before` and `skin` are the photo and skin, reduced.

    Eyes and teeth keep their color, whatever the skin's tone becomes.
    """
    smooth = copy.up(gaussian(before, _NEAR * copy.interocular))
    # What is brighter than most skin (shine) does not have the skin's color: it is shifted with it, not multiplied.
    brightest = np.quantile(before[skin], 0.8, axis=0).astype(np.float32)
    openings = features.openings
    pixels = np.empty_like(photo.pixels)

    def strip(rows: slice) -> None:
        values, excess = photo.pixels[rows], factor[rows] - 1
        if openings[rows].any():
            excess *= in_three_channels(1 - openings[rows])
        # A darker tone scales the texture, too; a brighter one leaves pores and grain as they are.
        texture = smooth[rows] - values
        base = values + texture * np.clip(2 - np.abs(texture) * (1 / _TEXTURE), 0, 1) * (excess > 0)
        change = (np.minimum(base, brightest) + _FLOOR) * excess
        beyond = values + _soft_limited(change, values)
        pixels[rows] = beyond + in_three_channels(core[rows]) * (painted.pixels[rows] - beyond)

    by_strips(strip, pixels.shape)
    return photo.with_pixels(pixels)


def _soft_limited(change: FloatArray, values: FloatArray) -> FloatArray:
    """d / (1 + (d / h)^4)^(1/4): the change d bent so that it stays below the headroom h to white, or to black."""
    headroom = np.where(change > 0, 1 - values, values)
    np.maximum(headroom, np.float32(1e-4), out=headroom)
    power = np.divide(change, headroom, out=headroom)
    np.square(power, out=power)
    np.square(power, out=power)
    power += 1
    np.sqrt(power, out=power)
    np.sqrt(power, out=power)
    return np.asarray(np.divide(change, power, out=power), np.float32)
