"""The color of dark skin: that of the same skin where it is lit.

The tone curves of cameras and editors make dark pixels more saturated than bright ones of the same material, creases
are reddened by the skin around them, a collar's bounce colors a jaw, and a shadow has the color of the second light in
the room. All this belongs to the photo's light and not to the albedo: light added to such a pixel in its own color
would make it glow orange, magenta or purple. The photo itself does not change, because the detail map takes up what the
albedo loses.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.blur import blurred
from graphface.nodes.bounding_box import bounding_box
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
    maps = [copy.up(values) for values in (usual, limit, bare, lit, excess)]
    window = None if face is None else bounding_box(face)
    result = albedo.copy()
    if face is not None and window is None:
        return result
    rows, columns = window or (slice(0, albedo.shape[0]), slice(0, albedo.shape[1]))

    def strip(part: slice) -> None:
        place = slice(rows.start + part.start, rows.start + part.stop), columns
        own, brightness = albedo[place], channel_mean(photo.pixels[place])
        usual, limit, bare, lit, excess = (values[place] for values in maps)
        is_face = np.float32(1) if face is None else face[place]
        grey = channel_mean(own)
        share = _darkness(brightness, usual, threshold) * is_face
        adapted = own * (1 + excess * in_three_channels(share))
        adapted = _less_saturated(adapted, limit, share)
        brighter = np.asarray(grey / np.maximum(channel_mean(adapted), np.float32(1e-6)), np.float32)
        adapted *= in_three_channels(brighter)
        share = _darkness(brightness, usual, black) * is_face * bare
        result[place] = adapted + in_three_channels(share) * (in_three_channels(grey) * lit - adapted)

    by_strips(strip, (rows.stop - rows.start, columns.stop - columns.start, 3))
    return result


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
