"""Relighting as a function of a pixel's color and of maps that are smooth: what is left to do at the photo's own size.

The maps are found on a small copy. This is the pixelwise part of `intrinsic.intensity`, `image.unclipped`,
`detail.split`, `render.response`, `render.composite` and `render.relit`, with the settings of the shipped graph.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.detail.split import bounded_exp
from graphface.nodes.enlargement import Enlarged, EnlargedMask, carried
from graphface.nodes.face_scale import face_scale
from graphface.nodes.render.composite import blended
from graphface.nodes.render.dark_texture import rough_below
from graphface.nodes.render.relit import with_light
from graphface.nodes.render.response import of_dark_skin, reflected_share
from graphface.nodes.rendering import applied, rendering, soft_limited
from graphface.nodes.types import DetailMap, FloatArray, Landmarks

_FLOOR = np.float32(0.08)
"""Of `intrinsic.intensity`."""

_DETAIL_FLOOR, _BOUND = np.float32(0.05), 2.0
"""Of `detail.split`."""

_RESPONSE_FLOOR = 0.02
"""Of `render.response`."""

_SHOULDER, _TOE = 0.5, 0.25
"""Of `render.relit`."""

_RADIUS, _RIDGE, _RESOLUTION = 0.06, 1e-3, 80
"""Of `matting.guided`: masks are carried as their soft edges are found."""

_ROUGHER, _SKIN = 3.0, 0.95
"""Of `render.response`, and the share of the face from which a pixel is skin."""

_WINDOW, _LEAST_VARIANCE = (5, 5), np.float32(1e-4)
"""Pixels, and the variance of albedo below which a window says nothing about how it depends on color."""

_VISIBLE = np.float32(1e-3)
"""A map that is nowhere larger says nothing."""


@dataclass(frozen=True)
class Layers:
    """A small picture and what relights it, at its size, h x w (x 3).

    Attributes:
        pixels: the small picture.
        landmarks, albedo, detail: of it.
        before, after: shading of the whole picture under the photo's own and the new light.
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
    share: FloatArray | None
    face: FloatArray
    response: FloatArray
    highlights: FloatArray | None
    encoded: bool


class Pixelwise:
    """What relights the pixels of a picture, of the layers of a small copy of it; its maps are enlarged by `at`."""

    def __init__(self, layers: Layers) -> None:
        small = layers.pixels
        copy = face_scale(layers.landmarks, small.shape, _RESOLUTION)
        raised = _raised(layers)
        source = small if raised is None else small + raised
        shading = _shading(source)
        slope, tint = _albedo_of_color(layers.albedo, source, shading)
        self.encoded = layers.encoded
        self.darkest = _darkest(layers)
        self._smooth = {"slope": slope, "tint": tint, "before": layers.before, "after": layers.after}
        if raised is not None:
            self._smooth["raised"] = raised
        rest = layers.response - _response(small, shading, layers.before, layers.face, self.darkest)
        if np.abs(rest).max(initial=0) > _VISIBLE:
            self._smooth["response"] = rest
        if layers.highlights is not None and layers.highlights.any():
            self._smooth["highlights"] = layers.highlights
        masks = {"face": layers.face} | ({} if layers.share is None else {"share": layers.share})
        self._masks = carried(masks, small, copy, radius=_RADIUS, ridge=_RIDGE)

    def at(self, size: tuple[int, int]) -> Enlargement:
        """The same for a picture of (height, width)."""
        smooth = {name: Enlarged(map_, size) for name, map_ in self._smooth.items()}
        return Enlargement(self, smooth, {name: mask.at(size) for name, mask in self._masks.items()})


@dataclass(frozen=True)
class Enlargement:
    """The maps of a `Pixelwise` at the size of a picture, which is relit a few rows at a time."""

    model: Pixelwise
    smooth: dict[str, Enlarged]
    masks: dict[str, EnlargedMask]

    def rows(self, rows: slice, pixels: FloatArray) -> FloatArray:
        """The relit pixels of some rows: float32 n x W x 3.

        Args:
            pixels: of the picture in these rows, n x W x 3.
        """
        smooth = {name: map_.rows(rows) for name, map_ in self.smooth.items()}
        source = pixels + smooth["raised"] if "raised" in smooth else pixels
        shading = _shading(source)
        albedo = source / in_three_channels(shading)
        albedo *= smooth["slope"]
        albedo += smooth["tint"]
        np.maximum(albedo, 0, out=albedo)
        rendered = rendering(albedo, smooth["before"])
        picture = rendering(albedo, self._lit(rows, pixels, shading, smooth))
        gain = in_three_channels(_gain(source, rendered))
        picture = applied(DetailMap(source - gain * rendered, gain, rendered, pixels), picture)
        result = np.empty_like(picture)
        soft_limited(picture, pixels, _SHOULDER, _TOE, out=result)
        if "highlights" in smooth:
            with_light(result, smooth["highlights"], self.model.encoded)
        return result

    def _lit(self, rows: slice, pixels: FloatArray, shading: FloatArray, smooth: dict[str, FloatArray]) -> FloatArray:
        """The new shading of some rows: n x W (x 3)."""
        masks = {name: mask.rows(rows, pixels) for name, mask in self.masks.items()}
        reflected = _response(pixels, shading, smooth["before"], masks["face"], self.model.darkest)
        if "response" in smooth:
            reflected += smooth["response"]
            np.clip(reflected, 0, 1, out=reflected)
        return blended(smooth["before"], smooth["after"], masks.get("share"), reflected)


def _raised(layers: Layers) -> FloatArray | None:
    """What reconstructed highlights are above the picture, or None where there are none."""
    detail = layers.detail
    if detail.ceiling is None or detail.pivot is None or detail.gain is None:
        return None
    raised = np.maximum(detail.gain * detail.pivot + detail.offset - layers.pixels, 0)
    return raised if raised.max(initial=0) > _VISIBLE else None


def _shading(pixels: FloatArray) -> FloatArray:
    return np.asarray(np.maximum(channel_mean(pixels), _FLOOR), np.float32)


def _gain(source: FloatArray, rendered: FloatArray) -> FloatArray:
    numerator, denominator = (channel_mean(values) + _DETAIL_FLOOR for values in (source, rendered))
    numerator /= denominator
    return bounded_exp(np.log(numerator, out=numerator), _BOUND)


def _albedo_of_color(albedo: FloatArray, source: FloatArray, shading: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Slope and offset, h x w x 3, of the graph's albedo as a linear function of the plain one, color over shading.

    Each channel's is found in windows of 5 x 5 pixels. The offset is exact, so the function gives the graph's albedo.
    """
    import cv2

    def mean(values: FloatArray) -> FloatArray:
        return np.asarray(cv2.blur(values, _WINDOW, borderType=cv2.BORDER_REFLECT), np.float32)

    plain = source / in_three_channels(shading)
    mean_plain, mean_albedo = mean(plain), mean(albedo)
    variance = mean(plain * plain) - mean_plain * mean_plain
    covariance = mean(plain * albedo) - mean_plain * mean_albedo
    # Where the plain albedo does not vary the slope is 1.
    slope = mean((covariance + _LEAST_VARIANCE) / (np.maximum(variance, 0) + _LEAST_VARIANCE))
    return slope, albedo - slope * plain


def _darkest(layers: Layers) -> float:
    """The brightness below which skin takes less light because it is noisy; 0 where all skin takes all of it."""
    if not ((layers.response < 1 - _VISIBLE) & (layers.face > _SKIN)).any():
        return 0.0
    return rough_below(channel_mean(layers.pixels), layers.face, layers.landmarks, _ROUGHER)


def _response(
    pixels: FloatArray, shading: FloatArray, before: FloatArray, face: FloatArray, darkest: float
) -> FloatArray:
    """`render.response` of a part of a picture, with the settings of the shipped graph."""
    on_skin = of_dark_skin(channel_mean(pixels), darkest) if darkest > 0 else np.float32(1)
    return reflected_share(shading, before, face, on_skin, _RESPONSE_FLOOR)
