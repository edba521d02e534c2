"""From the flow between two pictures to a better correspondence, or to none where it cannot be trusted.

The reference, carried over by the meshes, and the input show the same face in different paint: what should match are
the edges of eyes, brows, nostrils and lips, not their colors. So both are reduced to the logarithm of intensity, free
of its local mean and of unit local contrast. Flow is computed both ways; where the two disagree, where the pictures
still do not match after it, or where there is nothing to match, it has no weight, and a smooth field through what is
left moves the rest along. With no weight at all the meshes win.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import warn
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import face_scale
from graphface.nodes.resample import resampled
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Correspondence, FloatArray, Image, Landmarks

Flow = Callable[[NDArray[np.uint8], NDArray[np.uint8]], Any]
"""(from, to), both uint8 H x W, to displacements H x W x 2: to[x + flow(x)] looks like from[x]."""


Length = Annotated[float, Field(gt=0, le=2)]


Resolution = Annotated[int, Field(ge=16, le=400)]


_FLOOR = 0.05
"""Intensity below which differences are noise."""


_CONTRAST_FLOOR = 0.02


_CONTRAST = 45.0
"""Grey levels for one standard deviation of local contrast."""


_WORTH = 0.02
"""Share of the face that must be seen by its mirror image only, for that to be matched as well."""


_RESAMPLED = 0.02
"""Mean square difference that two copies of one picture have once one of them was resampled: no reason to move."""


_LEAST_SIDE = 8
"""Of the copies that are compared, pixels: smaller pictures have no flow."""


_PRIOR_WEIGHT = 0.15
"""Weight of "no displacement" beside that of the flow, where flow has full confidence: 1."""


@dataclass(frozen=True)
class Refinement:
    """How flow is used; lengths in inter-ocular distances.

    `resolution`: pixels per inter-ocular distance of the copies that are compared. `window`: size of what counts as
    local contrast. `tolerance`: disagreement of the two ways at which confidence has fallen to 1/e. `smoothing`: width
    of the field through the confident pixels. `reach`: a longer displacement is taken for a mistake.
    """

    resolution: int = 100
    window: float = 0.1
    tolerance: float = 0.03
    smoothing: float = 0.1
    reach: float = 0.15


def refined(
    photo: Image,
    reference: Image,
    correspondence: Correspondence,
    landmarks: Landmarks,
    flow: Flow,
    settings: Refinement,
) -> Correspondence:
    """The correspondence moved by a flow where that makes the two faces match; the same one where it does not.

    The mirror image that stands in for what the reference hides is another picture of the face, matched by itself.
    """
    unit = landmarks.interocular
    window = _face_window(correspondence.inside, margin=round(0.1 * unit))
    if window is None or unit < 8:
        if unit < 8:
            warn(f"flow: eyes are {unit:.1f} pixels apart, too few to match anything; the meshes alone decide")
        return correspondence
    direct = replace(correspondence, mirrored=None, mirrored_valid=None)
    places = _refined_places(photo, reference, direct, window, landmarks, flow, settings)
    mirrored, valid = correspondence.mirrored, correspondence.mirrored_valid
    if mirrored is not None and valid is not None and (valid > 0.5).mean() > _WORTH * correspondence.inside.mean():
        other = replace(direct, places=mirrored, valid=valid)
        window = _face_window(np.asarray(valid > 0.5, np.float32), margin=round(0.1 * unit)) or window
        mirrored = _refined_places(photo, reference, other, window, landmarks, flow, settings)
    return replace(correspondence, places=places, mirrored=mirrored)


def _refined_places(
    photo: Image,
    reference: Image,
    correspondence: Correspondence,
    window: tuple[slice, slice],
    landmarks: Landmarks,
    flow: Flow,
    settings: Refinement,
) -> FloatArray:
    """The places H x W x 2, moved within the window."""
    rows, columns = window
    size = rows.stop - rows.start, columns.stop - columns.start
    copy = face_scale(landmarks, size, settings.resolution, least=_LEAST_SIDE)
    unit = copy.interocular

    def small(values: FloatArray) -> FloatArray:
        return copy.down(values[rows, columns])

    inside = small(correspondence.inside * (correspondence.valid > 0.5))
    inside *= inside > 0.999  # beside the mesh there are no values to compare
    mine = _log_intensity(small(photo.pixels))
    reduced = replace(correspondence, places=small(correspondence.places), inside=inside, valid=inside)
    theirs = np.where(inside > 0.999, _log_intensity(resampled(reference.pixels, reduced)), mine)
    mine, theirs = (_equalized(values, settings.window * unit) for values in (mine, theirs))
    levels = [np.clip(128 + _CONTRAST * v, 0, 255).astype(np.uint8) for v in (mine, theirs)]
    forth = np.asarray(flow(levels[0], levels[1]), np.float32)
    back = np.asarray(flow(levels[1], levels[0]), np.float32)

    moved = _moved(theirs, forth)
    trust = inside * _agreement(forth, back, settings.tolerance * unit) * _match(mine, moved, unit)
    trust *= _improvement(mine, theirs, moved, unit)
    trust *= np.hypot(forth[..., 0], forth[..., 1]) < settings.reach * unit
    trust = np.nan_to_num(trust)
    field = _smooth(np.nan_to_num(forth) * trust[..., None], settings.smoothing * unit)
    field /= (_smooth(trust, settings.smoothing * unit) + _PRIOR_WEIGHT)[..., None]
    steps = np.array([size[1] / copy.size[1], size[0] / copy.size[0]], np.float32)
    shift = copy.up(field * steps)

    places = correspondence.places.copy()
    known = correspondence.inside[rows, columns]
    there = np.dstack([places[rows, columns] * known[..., None], known])

    def move(strip: slice) -> None:
        moved = _moved(there, shift[strip], strip.start)
        sure = moved[..., 2] > 0.999  # beyond the mesh's edge there is nothing to move to
        places[rows, columns][strip][sure] = moved[sure, :2]

    by_strips(move, there.shape)
    return places


def _log_intensity(pixels: FloatArray) -> FloatArray:
    intensity = np.maximum(channel_mean(pixels), 0)
    return np.asarray(np.log(intensity + np.float32(_FLOOR)), np.float32)


def _equalized(values: FloatArray, size: float) -> FloatArray:
    """Without local mean, of unit local contrast; flat places stay flat."""
    fine = values - _smooth(values, size)
    contrast = np.sqrt(np.maximum(_smooth(fine * fine, size), 0) + np.float32(_CONTRAST_FLOOR**2))
    return np.asarray(fine / contrast, np.float32)


def _agreement(forth: FloatArray, back: FloatArray, tolerance: float) -> FloatArray:
    """1 where going forth and back returns to the same pixel, falling with the distance."""
    miss = forth + _moved(back, forth)
    apart = np.hypot(miss[..., 0], miss[..., 1]) / max(tolerance, 1e-6)
    return np.asarray(np.exp(-np.square(np.minimum(apart, 10))), np.float32)


def _match(mine: FloatArray, theirs: FloatArray, unit: float) -> FloatArray:
    """Local correlation of the two pictures, 0 below 0.3 and 1 above 0.8; 0 where both are flat."""
    around = 0.04 * unit
    covariance = _smooth(mine * theirs, around)
    power = np.maximum(_smooth(mine * mine, around) * _smooth(theirs * theirs, around), 0) + np.float32(0.05)
    return np.asarray(np.clip((covariance / np.sqrt(power) - np.float32(0.3)) * 2, 0, 1), np.float32)


def _improvement(mine: FloatArray, before: FloatArray, after: FloatArray, unit: float) -> FloatArray:
    """1 where moving halves the difference between the pictures, 0 where it was none: what fits stays."""
    around = 0.04 * unit
    old, new = (_smooth(np.square(mine - theirs), around) for theirs in (before, after))
    gained = old - new - np.float32(_RESAMPLED)
    return np.asarray(np.clip(2 * gained / (old + np.float32(0.02)), 0, 1), np.float32)


def _moved(values: FloatArray, flow: FloatArray, top: int = 0) -> FloatArray:
    """values[x + flow(x)] at the rows from `top` on for which there is a flow."""
    import cv2

    places = flow + np.array([0, top], np.float32)
    places[..., 0] += np.arange(flow.shape[1], dtype=np.float32)
    places[..., 1] += np.arange(flow.shape[0], dtype=np.float32)[:, None]
    return np.asarray(cv2.remap(values, places, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE), np.float32)  # type: ignore[call-overload]


def _smooth(values: FloatArray, sigma: float) -> FloatArray:
    import cv2

    blurred = cv2.GaussianBlur(values, (0, 0), max(sigma, 0.5), borderType=cv2.BORDER_REPLICATE)
    return np.asarray(blurred, np.float32)


def _face_window(inside: FloatArray, margin: int) -> tuple[slice, slice] | None:
    """The box around the mesh, or None where there is no mesh."""
    rows = np.flatnonzero(inside.any(axis=1))
    columns = np.flatnonzero(inside.any(axis=0))
    if rows.size == 0:
        return None
    height, width = inside.shape
    y0, y1 = max(0, rows[0] - margin), min(height, rows[-1] + 1 + margin)
    x0, x1 = max(0, columns[0] - margin), min(width, columns[-1] + 1 + margin)
    return slice(int(y0), int(y1)), slice(int(x0), int(x1))
