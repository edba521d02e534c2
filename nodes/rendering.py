"""Albedo, shading and detail map put together to a picture.

`rendering` is what every detail map is measured against, `applied` puts a detail map onto another rendering, and
`recombined` keeps the result in the range that a picture can show.
"""

from __future__ import annotations

import numpy as np

from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Albedo, DetailMap, FloatArray, Image, Shading

_BLACK, _WHITE = np.float32(0), np.float32(1)


_LEAST_HEADROOM = 1e-6
"""Headroom that every value has at least, because it is divided by."""


_LEAST_BRIGHTNESS = np.float32(5e-3)
"""Of a rendering whose color is looked at, because it is divided by."""


_SPARSE = 8
"""If fewer than one value in so many lies beyond the knee, only those are computed."""


def rendering(albedo: Albedo, shading: Shading) -> FloatArray:
    """rho(x) SH(n(x), theta), the reconstruction I_e(x) without details (paper, equation 3).

    Args:
        albedo: rho, float32 H x W x 3. shading: float32 H x W or H x W x 3.

    Returns:
        float32 H x W x 3, a new array.

    >>> rendering(np.full((1, 1, 3), 0.5, np.float32), np.full((1, 1), 0.5, np.float32))
    array([[[0.25, 0.25, 0.25]]], dtype=float32)
    """
    if shading.ndim == 3:
        return albedo * shading
    rendered = in_three_channels(shading)
    rendered *= albedo
    return rendered


def applied(detail: DetailMap, rendered: FloatArray) -> FloatArray:
    """The picture that a detail map makes of a rendering, by the equation in `DetailMap`.

    Args:
        rendered: float32 H x W x 3; overwritten.

    Returns:
        float32 H x W x 3, not limited to [0, 1].

    >>> applied(DetailMap(np.full((1, 1, 3), 0.25, np.float32)), np.full((1, 1, 3), 0.5, np.float32))
    array([[[0.75, 0.75, 0.75]]], dtype=float32)
    """
    above_pivot = None
    picture = rendered
    if detail.pivot is not None:
        picture = np.minimum(rendered, detail.pivot)
        above_pivot = np.subtract(rendered, picture, out=rendered)
    if detail.gain is not None:
        picture *= detail.gain
    picture += detail.offset
    if detail.ceiling is not None:
        np.minimum(picture, detail.ceiling, out=picture)
    if above_pivot is not None:
        picture += above_pivot
        _fade_tint(picture, above_pivot, detail)
    return picture


def _fade_tint(picture: FloatArray, added: FloatArray, detail: DetailMap) -> None:
    """Take away, in place, what the photo's color differs from the albedo's, the more of it the more light is added.

    With a difference map that color would stay however bright the pixel becomes: the purple of a shadow that is lit.
    The factor is (before / after)^3 of the rendering's brightness, so it is 1 where no light is added.
    """
    pivot, gain = detail.pivot, detail.gain
    if pivot is None or gain is None or not added.any():
        return
    before = channel_mean(pivot)
    fading = tint_fading(before, channel_mean(added))
    np.maximum(before, _LEAST_BRIGHTNESS, out=before)
    photo = gain * pivot
    photo += detail.offset
    # photo - pivot * |photo| / |pivot|, times the part that fades
    brightness = channel_mean(photo)
    brightness *= fading
    brightness /= before
    photo *= in_three_channels(fading)
    picture -= photo
    picture += in_three_channels(brightness) * pivot


def bounded_exp(log_ratio: FloatArray, bound: float) -> FloatArray:
    """exp(L tanh(log_ratio / L)) with L = log(bound): near 1 the ratio itself, and always in 1 / bound .. bound."""
    limit = np.float32(max(np.log(bound), 1e-6))
    gain: FloatArray = np.exp(limit * np.tanh(log_ratio / limit))
    return gain


def tint_fading(before: FloatArray, added: FloatArray) -> FloatArray:
    """1 - (before / (before + added))^3, or less where the rendering is black.

    Args:
        before, added: brightness of the rendering and of the light that is added to it, H x W.
    """
    known = np.clip(before / _LEAST_BRIGHTNESS - 1, 0, 1)  # a black rendering says nothing of the albedo's color
    before = np.maximum(before, _LEAST_BRIGHTNESS)
    fading = before / (added + before)
    fading *= fading * fading
    np.subtract(1, fading, out=fading)
    fading *= known
    return fading


def recombined(
    photo: Image, albedo: Albedo, shading: Shading, detail: DetailMap, shoulder: float = 0.5, toe: float = 0.5
) -> Image:
    """A picture from its parts; see `blend.recombine`.

    Args:
        photo: the picture before the edit; the change from it is limited. Its alpha and file format are kept.
        shoulder, toe: 0 to 1, see `soft_limited`.
    """
    pixels = np.empty(photo.pixels.shape, np.float32)

    def strip(rows: slice) -> None:
        picture = applied(_rows_of(detail, rows), rendering(albedo[rows], shading[rows]))
        soft_limited(picture, photo.pixels[rows], shoulder, toe, out=pixels[rows])

    by_strips(strip, pixels.shape)
    return photo.with_pixels(pixels)


def _rows_of(detail: DetailMap, rows: slice) -> DetailMap:
    parts = {name: getattr(detail, name) for name in ("gain", "pivot", "ceiling")}
    return DetailMap(detail.offset[rows], **{name: part[rows] for name, part in parts.items() if part is not None})


def soft_limited(picture: FloatArray, before: FloatArray, shoulder: float, toe: float, out: FloatArray) -> None:
    """The new picture, with its change limited to the headroom that each value had up to 1, or down to 0.

    A change passes unaltered up to the share 1 - shoulder of the headroom (downwards 1 - toe). Beyond this knee the
    curve bends without a kink and approaches the limit exponentially, like shoulder and toe of a film's characteristic
    curve. Each channel has its own headroom, so bright colors drift to white as on film. One factor for all channels
    would keep the hue; it was rejected, because where one channel is clipped already the others are held back in
    patches.
    """
    black, white = _limits(before)
    low, high = np.float32(toe), np.float32(shoulder)
    np.maximum(picture, before * low + (1 - low) * black, out=out)
    np.minimum(out, before * high + (1 - high) * white, out=out)
    beyond = picture != out
    count = np.count_nonzero(beyond)
    if count * _SPARSE > picture.size:
        out[...] = _rolled_off(picture, out, before, black, white, shoulder, toe)
    elif count:
        places = np.flatnonzero(beyond)
        few, knees, start = (values.reshape(-1).take(places) for values in (picture, out, before))
        least, most = (limit.reshape(-1).take(places) if limit.ndim else limit for limit in (black, white))
        out.reshape(-1)[places] = _rolled_off(few, knees, start, least, most, shoulder, toe)


def _limits(before: FloatArray) -> tuple[FloatArray | np.float32, FloatArray | np.float32]:
    """0 and 1, extended to the photo's own values where it exceeds them."""
    black: FloatArray | np.float32 = _BLACK
    white: FloatArray | np.float32 = _WHITE
    if before.size and before.min() < 0:
        black = np.minimum(before, black)
    if before.size and before.max() > 1:
        white = np.maximum(before, white)
    return black, white


def _rolled_off(
    picture: FloatArray,
    knee: FloatArray,
    before: FloatArray,
    black: FloatArray | np.float32,
    white: FloatArray | np.float32,
    shoulder: float,
    toe: float,
) -> FloatArray:
    """knee + h (1 - exp(-e / h)) for an excess e of the picture over the knee; the headroom h has the sign of e.

    One formula serves both signs, because to select one of two results (`np.where`) takes as long as a dozen
    multiplications.
    """
    import cv2

    excess = np.subtract(knee, picture)  # -e
    # h = shoulder * (white - before) upwards, toe * (black - before) downwards, kept away from 0 on its own side.
    upwards = cv2.threshold(excess, 0, 1, cv2.THRESH_BINARY_INV)[1]
    headroom = np.asarray(upwards, np.float32).reshape(excess.shape)
    below = np.float32(toe) * (black - before) - np.float32(_LEAST_HEADROOM)
    above = np.float32(shoulder) * (white - before) + np.float32(_LEAST_HEADROOM)
    above -= below
    headroom *= above
    headroom += below
    excess /= headroom
    np.expm1(excess, out=excess)
    excess *= headroom
    np.subtract(knee, excess, out=excess)
    np.maximum(excess, black, out=excess)
    return np.minimum(excess, white, out=excess)
