"""The color of dark skin: that of the same skin where it is lit.

The tone curves of cameras and editors make dark pixels more saturated than bright ones of the same material, creases
are reddened by the skin around them, a collar's bounce colors a jaw, and a shadow has the color of the second light in
the room. All this belongs to the photo's light and not to the albedo: light added to such a pixel in its own color
would make it glow orange, magenta or purple. The photo itself does not change, because the detail map takes up what the
albedo loses.
"""

from __future__ import annotations

from functools import partial
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.face_outlines import EYES, LIPS
from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, FloatArray, Image, Landmarks, Mask

_LEAST = np.float32(1e-3)

_REGION = 0.15
"""Standard deviation of the averages over dark skin, in inter-ocular distances."""

_LARGEST_FACTOR = np.float32(2.5)
"""Of one channel against the others: skin under a second light is never farther from lit skin."""

_FAINT = np.float32(0.01)
"""Where the label is less than this there is no skin. Soft labels are hardly ever 0."""

_MARGIN = 0.05
"""Width around eyes and lips that counts with them, in inter-ocular distances."""


@node("albedo.shadow_color", version=2, formerly=("albedo.shadow_colour",))
def shadow_color(
    albedo: Albedo,
    photo: Image,
    mask: Mask,
    landmarks: Landmarks,
    face: Mask | None = None,
    *,
    threshold: Annotated[float, Field(gt=0, le=3), Formerly("dark")] = 1.3,
    black: Annotated[float, Field(gt=0, le=3)] = 0.8,
    sigma: Annotated[float, Field(gt=0, le=5), Formerly("reach")] = 1.0,
    resolution: Annotated[int, Field(ge=8, le=256)] = 24,
) -> Albedo:
    """Give dark skin the color of the lit skin around; brightness stays.

    In proportion to how dark a pixel is against lit skin, the mean color of the dark skin around is adapted to that of
    lit skin (von Kries: one factor a channel), so freckles and blush go on differing from what surrounds them, and the
    saturation is limited to that of lit skin. A pixel so dark that its own color says nothing takes lit skin's. Eyes
    and lips have colors of their own: only their saturation is limited.

    Args:
        albedo: of an intrinsic method, H x W x 3.
        photo: the picture that it was computed from.
        mask: the face by its geometry, H x W; lit skin is averaged over it.
        face: where skin is, H x W, such as the label face; nothing else changes. None takes all for skin.
        threshold: share of lit skin's brightness below which a pixel begins to count as dark; at half of it, it counts
            in full.
        black: the same, for pixels that take the color of lit skin altogether.
        sigma: standard deviation of the averages over lit skin, in inter-ocular distances.
        resolution: pixels per inter-ocular distance of the copy on which averages are taken.
    """
    copy = face_scale(landmarks, albedo.shape, resolution)
    small, skin = copy.down(photo.pixels), copy.down(mask)
    bare = 1 - _eyes_and_lips(landmarks, copy)
    on_face = np.ones_like(skin) if face is None else copy.down(face)
    usual, limit, lit = _lit_skin(small, skin * on_face * bare + _LEAST, max(sigma * copy.interocular, 0.5))
    dark = _darkness(channel_mean(small), usual, threshold) * on_face * bare
    excess = copy.up((_adaptation(small, lit, dark, copy) - 1) * in_three_channels(bare))
    usual, limit, bare, lit = (copy.up(values) for values in (usual, limit, bare, lit))
    result = albedo.copy()

    def strip(rows: slice) -> None:
        brightness = channel_mean(photo.pixels[rows])
        is_face = np.float32(1) if face is None else np.clip((face[rows] - _FAINT) / (1 - _FAINT), 0, 1)
        dark = _darkness(brightness, usual[rows], threshold) * is_face
        darker = _darkness(brightness, usual[rows], black) * is_face * bare[rows]
        places = np.flatnonzero(np.maximum(dark, darker))
        if len(places):
            # Few pixels are dark skin: only they are computed, as a picture of one row.
            few = partial(_at, places)
            own, share = few(albedo[rows]), few(dark)
            grey = channel_mean(own)
            adapted = own * (1 + few(excess[rows]) * in_three_channels(share))
            adapted = _less_saturated(adapted, few(limit[rows]), share)
            brighter = np.asarray(grey / np.maximum(channel_mean(adapted), np.float32(1e-6)), np.float32)
            adapted *= in_three_channels(brighter)
            adapted += in_three_channels(few(darker)) * (in_three_channels(grey) * few(lit[rows]) - adapted)
            result[rows].reshape(-1, 3)[places] = adapted[0]

    by_strips(strip, albedo.shape)
    return result


def _at(places: NDArray[np.intp], map_: FloatArray) -> FloatArray:
    """Pixels of a map H x W (x c) by their numbers, as a map 1 x n (x c)."""
    return map_.reshape(-1, *map_.shape[2:]).take(places, axis=0)[None]


def _lit_skin(small: FloatArray, skin: FloatArray, sigma: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Brightness h x w, saturation h x w and color over brightness h x w x 3 of the skin around, bright pixels most."""
    brightness, saturation = _mean_and_saturation(small)
    weight = skin * np.square(brightness) + np.float32(1e-9)
    sums = blurred(np.dstack([weight, weight * brightness, weight * saturation]), sigma)
    lit = blurred(_color(small, brightness) * in_three_channels(weight), sigma) / sums[..., :1]
    return sums[..., 1] / sums[..., 0], sums[..., 2] / sums[..., 0], lit


def _color(pixels: FloatArray, brightness: FloatArray) -> FloatArray:
    """Pixels over their brightness: the mean of the channels is 1, and black is grey."""
    return (pixels + _LEAST) / in_three_channels(brightness + _LEAST)


def _darkness(brightness: FloatArray, usual: FloatArray, threshold: float) -> FloatArray:
    """0 where a pixel has at least the share `threshold` of the usual brightness, 1 where it has at most half of it."""
    share = brightness / np.maximum(usual, _LEAST)
    share *= np.float32(-2 / threshold)
    share += 2
    return np.asarray(np.clip(share, 0, 1, out=share), np.float32)


def _adaptation(small: FloatArray, lit: FloatArray, dark: FloatArray, copy: FaceScale) -> FloatArray:
    """The factors, h x w x 3, from the mean color of the dark skin around to that of lit skin."""
    weight = dark + np.float32(1e-4)
    color = _color(small, channel_mean(small))
    sigma = max(_REGION * copy.interocular, 0.5)
    own = blurred(color * in_three_channels(weight), sigma) / in_three_channels(blurred(weight, sigma))
    factors = np.maximum(lit, _LEAST) / np.maximum(own, _LEAST)
    return np.asarray(np.clip(factors, 1 / _LARGEST_FACTOR, _LARGEST_FACTOR), np.float32)


def _less_saturated(color: FloatArray, limit: FloatArray, share: FloatArray) -> FloatArray:
    """Colors whose saturation beyond the limit is reduced by a share of the excess."""
    mean, own = _mean_and_saturation(color)
    reduction = np.maximum(own - limit, 0)
    reduction *= share
    reduction /= np.maximum(own, _LEAST)
    grey = in_three_channels(mean)
    return grey + in_three_channels(1 - reduction) * (color - grey)


def _mean_and_saturation(pixels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Intensity I and saturation S = 1 - min(R, G, B) / I of the HSI color model, H x W each: S is 0 for grey."""
    mean = channel_mean(pixels)
    least = np.minimum(np.minimum(pixels[..., 0], pixels[..., 1]), pixels[..., 2])
    return mean, np.maximum(1 - least / np.maximum(mean, _LEAST), 0)


def _eyes_and_lips(landmarks: Landmarks, copy: FaceScale) -> FloatArray:
    """Soft mask, h x w, on the small copy; 0 everywhere for other landmarks than FaceMesh's."""
    import cv2

    drawn = np.zeros(copy.size, np.float32)
    points = landmarks.points[:, :2] * np.float32(copy.scale)
    if landmarks.scheme != "facemesh468":
        return drawn
    margin = 2 * max(1, round(2 * _MARGIN * copy.interocular) // 2)
    for outline in (*EYES, LIPS):
        corners = points[list(outline)]
        if np.isfinite(corners).all() and np.abs(corners).max() < 1 << 20:
            polygon = np.round(corners * 16).astype(np.int32)
            cv2.fillPoly(drawn, [polygon], 1.0, cv2.LINE_8, 4)
            cv2.polylines(drawn, [polygon], True, 1.0, margin, cv2.LINE_8, 4)
    return blurred(drawn, max(_MARGIN / 2 * copy.interocular, 0.5))
