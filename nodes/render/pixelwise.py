"""Relighting as a function of a pixel's color and of maps that are smooth: what is left to do at the photo's own size.

With the plain albedo of a pixel, color over intensity, and what the small picture says of it, the pixel becomes

    color + albedo * (gain * removed + added),

where `removed` and `added` are the two signs of the change of its shading. That is what `detail.split` and
`render.relit` make of it, written in one line; then the color of a shadow fades and the change is limited as they do
it. The settings are those of the shipped graph. Channels are separate planes, which is twice as fast.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.enlargement import Enlarged, linear_masks
from graphface.nodes.face_scale import face_scale
from graphface.nodes.render.dark_texture import rough_below
from graphface.nodes.render.relit import with_light
from graphface.nodes.render.response import of_dark_skin, reflected_share
from graphface.nodes.rendering import bounded_exp, soft_limited, tint_fading
from graphface.nodes.types import DetailMap, FloatArray, Landmarks

_FLOOR = np.float32(0.08)
"""Of `intrinsic.intensity`."""

_DETAIL_FLOOR, _BOUND = np.float32(0.05), 2.0
"""Of `detail.split`."""

_RESPONSE_FLOOR, _ROUGHER = 0.02, 3.0
"""Of `render.response`."""

_SHOULDER, _TOE = 0.5, 0.25
"""Of `render.relit`."""

_RADIUS, _RIDGE, _RESOLUTION = 0.06, 1e-3, 80
"""Of `matting.guided`: masks are carried as their soft edges are found."""

_SKIN = 0.95
"""Share of the face from which a pixel is skin."""

_WINDOW, _LEAST_VARIANCE = (5, 5), np.float32(1e-4)
"""Pixels, and the variance of albedo below which a window says nothing about how it depends on color."""

_LEAST_ALBEDO = np.float32(1e-3)
"""Mean of the channels, which is divided by."""

_VISIBLE = np.float32(1e-3)
"""A map that is nowhere larger says nothing."""


@dataclass(frozen=True)
class Layers:
    """A small picture and what relights it, at its size, h x w (x 3).

    Attributes:
        pixels: the small picture.
        landmarks, albedo, detail: of it.
        before, after: shading of the whole picture under the photo's own and the new light.
        wall: that of the background under the new light, or None. background: label.
        share: of the new shading that a pixel gets, or None for all of it.
        face: label. response: see `render.response`.
        highlights: linear light, or None.
        encoded: whether the values are sRGB.
    """

    pixels: FloatArray
    landmarks: Landmarks
    albedo: FloatArray
    detail: DetailMap
    before: FloatArray
    after: FloatArray
    wall: FloatArray | None
    background: FloatArray
    share: FloatArray | None
    face: FloatArray
    response: FloatArray
    highlights: FloatArray | None
    encoded: bool


class Pixelwise:
    """What relights pixels, of the layers of a small picture; `at` enlarges its maps."""

    def __init__(self, layers: Layers) -> None:
        small = layers.pixels
        raised = _raised(layers)
        source = small if raised is None else small + raised
        shading = np.maximum(channel_mean(source), _FLOOR)
        slope, tint = _albedo_of_color(layers.albedo, source, shading)
        before = layers.before if layers.before.ndim == 3 else layers.before[..., None]
        after = layers.after if layers.after.ndim == 3 else layers.after[..., None]
        self.encoded = layers.encoded
        self.darkest = _darkest(layers)
        self.maps = {
            "slope": _planes(slope),
            "tint": _planes(tint),
            "before": _planes(before),
            "change": _planes(after - before),
        }
        if raised is not None:
            self.maps["raised"] = _planes(raised)
        rest = layers.response - self.response(channel_mean(small), shading, channel_mean(layers.before), layers.face)
        if np.abs(rest).max(initial=0) > _VISIBLE:
            self.maps["response"] = [rest]
        masks = {"face": layers.face} | ({} if layers.share is None else {"share": layers.share})
        if layers.wall is not None:
            wall = layers.wall if layers.wall.ndim == 3 else layers.wall[..., None]
            self.maps["farther"] = _planes(wall - after)
            masks["background"] = layers.background
        copy = face_scale(layers.landmarks, small.shape, _RESOLUTION)
        self.maps |= linear_masks(masks, small, copy, radius=_RADIUS, ridge=_RIDGE)
        if layers.highlights is not None and layers.highlights.any():
            self.maps["highlights"] = _planes(layers.highlights)

    def response(self, brightness: FloatArray, shading: FloatArray, before: FloatArray, face: FloatArray) -> FloatArray:
        """`render.response` of a part of a picture, with the settings of the shipped graph."""
        on_skin = of_dark_skin(brightness, self.darkest) if self.darkest > 0 else np.float32(1)
        return reflected_share(shading, before, face, on_skin, _RESPONSE_FLOOR)

    def at(self, size: tuple[int, int]) -> EnlargedPixelwise:
        """The same for a picture of (height, width)."""
        names = [name for name, planes in self.maps.items() for _ in planes]
        return EnlargedPixelwise(self, names, Enlarged([one for planes in self.maps.values() for one in planes], size))


@dataclass(frozen=True)
class EnlargedPixelwise:
    """A `Pixelwise` for a picture of a given size, which is relit a few rows at a time; `names` are those of `maps`."""

    model: Pixelwise
    names: list[str]
    maps: Enlarged

    def rows(self, rows: slice, pixels: FloatArray) -> FloatArray:
        """The relit pixels of some rows: float32 n x W x 3.

        Args:
            pixels: of the picture in these rows, n x W x 3.
        """
        import cv2

        maps: dict[str, list[FloatArray]] = {}
        for name, plane in zip(self.names, self.maps.rows(rows), strict=True):
            maps.setdefault(name, []).append(plane)
        color = [np.asarray(plane, np.float32) for plane in cv2.split(pixels)]
        picture = np.asarray(cv2.merge(self._relit(color, maps)), np.float32)
        result = np.empty_like(picture)
        soft_limited(picture, pixels, _SHOULDER, _TOE, out=result)
        if "highlights" in maps:
            with_light(result, np.asarray(cv2.merge(maps["highlights"]), np.float32), self.model.encoded)
        return result

    def _relit(self, color: list[FloatArray], maps: dict[str, list[FloatArray]]) -> list[FloatArray]:
        """The three channels, not yet limited."""
        source = [c + r for c, r in zip(color, maps["raised"], strict=True)] if "raised" in maps else color
        intensity = _mean(source)
        shading = np.maximum(intensity, _FLOOR)
        inverse = np.asarray(1 / shading, np.float32)
        albedo = [
            _albedo(one, inverse, slope, tint)
            for one, slope, tint in zip(source, maps["slope"], maps["tint"], strict=True)
        ]
        before, mean_albedo = maps["before"], _mean(albedo)
        removed, added = self._changes(color, shading, maps)
        rendered = (
            mean_albedo * before[0] if len(before) == 1 else _mean([a * s for a, s in zip(albedo, before, strict=True)])
        )
        gain = _gain(intensity, rendered)
        light = (
            mean_albedo * added[0] if len(added) == 1 else _mean([a * s for a, s in zip(albedo, added, strict=True)])
        )
        fading = tint_fading(rendered, light)
        kept = 1 - fading
        # What fades gives way to the same intensity in the color of the rendering.
        fading *= intensity
        fading /= np.maximum(mean_albedo if len(before) == 1 else rendered, _LEAST_ALBEDO)
        relit = []
        for channel in range(3):
            less, more = removed[channel % len(removed)] * gain, added[channel % len(added)]
            own = albedo[channel]
            if "raised" in maps:
                less *= own
                less += maps["raised"][channel]
                np.minimum(less, 0, out=less)
                part = color[channel] + less
                part += (kept - 1) * source[channel]
                less = more + 0
            else:
                part = color[channel] * kept
                less += more
            less += fading if len(before) == 1 else fading * before[channel]
            less *= own
            part += less
            relit.append(part)
        return relit

    def _changes(
        self, color: list[FloatArray], shading: FloatArray, maps: dict[str, list[FloatArray]]
    ) -> tuple[list[FloatArray], list[FloatArray]]:
        """What is taken from the shading and what is added to it, in one or three channels."""
        face = _linear(maps["face"], color)
        response = self.model.response(_mean(color), shading, _mean(maps["before"]), face)
        if "response" in maps:
            response += maps["response"][0]
            np.clip(response, 0, 1, out=response)
        changes = maps["change"]
        if "farther" in maps:
            background = _linear(maps["background"], color)
            farther = [plane * background for plane in maps["farther"]]
            count = max(len(changes), len(farther))
            changes = [changes[c % len(changes)] + farther[c % len(farther)] for c in range(count)]
        if "share" in maps:
            share = _linear(maps["share"], color)
            changes = [change * share for change in changes]
        removed = [np.minimum(change, 0) for change in changes]
        added = [np.maximum(change, 0) for change in changes]
        for one in added:
            one *= response
        return removed, added


def _planes(map_: FloatArray) -> list[FloatArray]:
    return [np.ascontiguousarray(map_[..., channel]) for channel in range(map_.shape[2])]


def _mean(planes: list[FloatArray]) -> FloatArray:
    if len(planes) == 1:
        return planes[0]
    mean = planes[0] + planes[1]
    mean += planes[2]
    mean *= np.float32(1 / 3)
    return mean


def _albedo(source: FloatArray, inverse: FloatArray, slope: FloatArray, tint: FloatArray) -> FloatArray:
    albedo = source * inverse
    albedo *= slope
    albedo += tint
    np.maximum(albedo, 0, out=albedo)
    return albedo


def _linear(function: list[FloatArray], color: list[FloatArray]) -> FloatArray:
    """a . color + b, in [0, 1]."""
    *slopes, value = function
    value = np.array(value, np.float32)
    for slope, plane in zip(slopes, color, strict=True):
        value += slope * plane
    return np.clip(value, 0, 1, out=value)


def _gain(intensity: FloatArray, rendered: FloatArray) -> FloatArray:
    ratio = intensity + _DETAIL_FLOOR
    ratio /= rendered + _DETAIL_FLOOR
    np.maximum(ratio, _LEAST_ALBEDO, out=ratio)
    return bounded_exp(np.log(ratio, out=ratio), _BOUND)


def _raised(layers: Layers) -> FloatArray | None:
    """What reconstructed highlights are above the picture, or None where there are none."""
    detail = layers.detail
    if detail.ceiling is None or detail.pivot is None or detail.gain is None:
        return None
    raised = np.maximum(detail.gain * detail.pivot + detail.offset - layers.pixels, 0)
    return raised if raised.max(initial=0) > _VISIBLE else None


def _albedo_of_color(albedo: FloatArray, source: FloatArray, shading: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Slope and offset, h x w x 3, of the graph's albedo as a linear function of the plain one, color over shading.

    Each channel's is found in small windows. The offset is exact, so the function gives the graph's albedo.
    """
    import cv2

    def mean(values: FloatArray) -> FloatArray:
        return np.asarray(cv2.blur(values, _WINDOW, borderType=cv2.BORDER_REFLECT), np.float32)

    plain = np.asarray(source / in_three_channels(np.asarray(shading, np.float32)), np.float32)
    mean_plain, mean_albedo = mean(plain), mean(albedo)
    variance = mean(plain * plain) - mean_plain * mean_plain
    covariance = mean(plain * albedo) - mean_plain * mean_albedo
    # Where the plain albedo does not vary the slope is 1.
    variance = np.maximum(variance, 0) + _LEAST_VARIANCE
    slope = mean(np.asarray((covariance + _LEAST_VARIANCE) / variance, np.float32))
    return slope, albedo - slope * plain


def _darkest(layers: Layers) -> float:
    """The brightness below which skin takes less light because it is noisy; 0 where all skin takes all of it."""
    if not ((layers.response < 1 - _VISIBLE) & (layers.face > _SKIN)).any():
        return 0.0
    return rough_below(channel_mean(layers.pixels), layers.face, layers.landmarks, _ROUGHER)
