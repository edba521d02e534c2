"""A layer of makeup over a face that keeps its own skin."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import gaussian, normalized
from graphface.nodes.bounding_box import Box, bounding_box
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.makeup.bare_skin import bare_color
from graphface.nodes.makeup.brow_hair import brow_hair
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.strips import by_strips
from graphface.nodes.types import BareSkin, Features, FloatArray, Image, Landmarks, Mask, Paint, Surface

Share = Annotated[float, Field(ge=0, le=1)]


_FLOOR = np.float32(0.04)
"""Added to colors before the logarithm."""


_FINE = 0.035
"""Sigma, in inter-ocular distances, of the Gaussian that separates relief from paint."""


_LARGEST_FINE = np.float32(0.6)


_LEAST_LIGHT, _LARGEST_LIGHT = 0.3, 3.0
"""Of the light at a pixel over that in the middle of the face."""


_LEAST_EXPOSURE = 0.2
"""Of the ratio of two skins' lightness."""


_LEAST_DEPARTURE, _LARGEST_DEPARTURE = np.float32(-3), np.float32(1.5)
"""Natural logarithms."""


_SPREAD_RESOLUTION, _EDGE = 48, 0.1
"""Pixels per inter-ocular distance of the copy on which greasepaint is continued, and how far before the mesh's edge it
fades, in inter-ocular distances."""


_TURNED, _FACING = 0.15, 0.35
"""z of the normal at which the face turns out of sight, and from which on it is painted in full."""


@node("makeup.layer")
def layer(
    photo: Image,
    bare: BareSkin,
    paint: Paint,
    core: Mask,
    surface: Surface,
    features: Features,
    landmarks: Landmarks,
    skin: Mask | None = None,
    *,
    relief: Share = 0.35,
    relief_lips: Share = 0.65,
    brows: Share = 1.0,
    exposure: Share = 0.35,
) -> Image:
    """The photo under the makeup: photo * exp(d) * (1 - a) + a * pigment, with opacity a and departure d.

    The pigment is the wearer's bare skin times exp(d) under the photo's own light. Where the layer is 0 the photo stays
    to the last bit. What the photo wears already in the direction of d is not put on a second time.

    Args:
        bare: the photo's own skin. paint: the layer, warped to the photo. core: where it is known and may go.
        skin: where greasepaint goes on beyond that, as far as the mesh reaches.
        relief, relief_lips: share of the fine lightness that is the photo's own and not the layer's.
        brows: share of the photo's own brows that is seen through opaque paint.
        exposure: share of the ratio of the two skins' lightness that opaque paint is darkened by. At 0 paint has the
            same color on any skin, which is true under the same exposure; portraits of dark skin are exposed longer,
            and those of pale skin are often overexposed.
    """
    if skin is not None and paint.greasepaint > 0:
        paint, core = _continued(paint, core, np.minimum(skin, surface.coverage), landmarks)
    box = bounding_box((core > 0) & ((paint.opacity > 0) | (paint.departure != 0).any(axis=2)))
    if box is None:
        return photo
    color = bare_color(bare, surface)
    own = _Own(face_scale(landmarks, core[box].shape, 100), box, photo, bare, features, float(color.mean()))
    facing = np.clip((surface.normals[box][..., 2] - _TURNED) / (_FACING - _TURNED), 0, 1)
    weight = np.asarray(core[box] * facing * (1 - np.minimum(features.openings[box], 1)), np.float32)
    darker = np.clip(color.mean() / max(float(paint.skin.mean()), 1e-3), _LEAST_EXPOSURE, _LARGEST_LIGHT)
    pigment = paint.skin * np.float32(darker**exposure)
    blend = _blend(own, paint, weight, pigment, relief, relief_lips, brows)
    pixels = photo.pixels[box]
    result = photo.pixels.copy()
    into = result[box]

    def strip(rows: slice) -> None:
        into[rows] = blend.rows(rows, pixels[rows])

    by_strips(strip, pixels.shape)
    return photo.with_pixels(result)


class _Own:
    """What the photo shows in the painted part of the face: `pixels` and logarithms on a small copy of it."""

    def __init__(
        self, copy: FaceScale, box: Box, photo: Image, bare: BareSkin, features: Features, lightness: float
    ) -> None:
        self.copy, self.box = copy, box
        self.pixels, color = copy.down(photo.pixels[box]), copy.down(bare.color[box])
        smooth = gaussian(self.pixels, 0.008 * copy.interocular)
        self.departure = np.log(np.maximum(smooth, 0) + _FLOOR) - np.log(np.maximum(color, 0) + _FLOOR)
        self.log = np.log(np.maximum(channel_mean(self.pixels), 0) + _FLOOR)
        mean = np.maximum(channel_mean(color), _FLOOR / 2)
        self.skin_log = np.asarray(np.log(mean + _FLOOR), np.float32)
        self.light = np.asarray(
            np.clip(mean / np.float32(max(lightness, 1e-3)), _LEAST_LIGHT, _LARGEST_LIGHT), np.float32
        )
        self.lips: FloatArray = features.lips[box]
        self.eyes, self.brows = (copy.down(getattr(features, name)[box]) for name in ("eyes", "brows"))

    def worn(self, departure: FloatArray) -> FloatArray:
        """Share of a departure that the photo has already, h x w, 0 to 1."""
        along = np.einsum("hwc,hwc->hw", self.departure, departure)
        return np.asarray(np.clip(along / np.maximum(np.square(departure).sum(axis=2), 1e-4), 0, 1), np.float32)

    def brow_hair(self) -> FloatArray:
        return brow_hair(self.pixels, self.departure, self.brows, self.eyes, self.copy.interocular)


@dataclass(frozen=True)
class _Blend:
    """What a painted part of a picture is made of.

    Attributes:
        departure: of the layer from bare skin, n x m x 3; `broad` its mean without relief, `on_lips` its broad color on
            the lips.
        weight: how much of the layer is put on; `sheer` less where it is worn already.
        opacity, lips, hair: shares. keep: share of the photo's relief, and `taken` that of its lips.
        own_broad: the photo's logarithm without relief. skin_log: that of its bare skin.
        pigment: color of opaque bare skin (3,). light: on the photo's skin.
    """

    departure: FloatArray
    broad: FloatArray
    on_lips: FloatArray
    weight: FloatArray
    sheer: FloatArray
    opacity: FloatArray
    lips: FloatArray
    taken: FloatArray
    keep: FloatArray
    hair: FloatArray
    own_broad: FloatArray
    skin_log: FloatArray
    pigment: FloatArray
    light: FloatArray

    def rows(self, rows: slice, pixels: FloatArray) -> FloatArray:
        """The painted pixels of some rows; where nothing is put on they stay to the last bit."""
        departure, opacity = self.departure[rows], self.opacity[rows]
        # Gloss and lines of the other lips have a color of their own, and go as a whole.
        put_on = departure - in_three_channels(self.taken[rows]) * (departure - self.on_lips[rows])
        painted = pixels * np.exp(put_on * in_three_channels(self.sheer[rows]))
        opaque = np.exp(put_on) * self.pigment * in_three_channels(self.light[rows] * self._relief(rows, pixels))
        painted += in_three_channels(opacity) * (opaque - painted)
        there = (opacity > 0) | ((np.abs(put_on).max(axis=2) * self.weight[rows]) > 0)
        return np.where(there[..., None], np.clip(painted, 0, 1), pixels)

    def _relief(self, rows: slice, pixels: FloatArray) -> FloatArray:
        """What of the photo's relief and brows shows through opaque paint, a factor n x m."""
        log = np.log(np.maximum(channel_mean(pixels), 0) + _FLOOR)
        of_layer = (1 - self.lips[rows]) * (channel_mean(self.departure[rows]) - self.broad[rows])
        fine = np.clip(log - self.own_broad[rows] - of_layer, -_LARGEST_FINE, _LARGEST_FINE)
        return np.asarray(
            np.exp(self.keep[rows] * fine + self.hair[rows] * np.clip(log - self.skin_log[rows], -2, 0)), np.float32
        )


def _blend(
    own: _Own, paint: Paint, weight: FloatArray, pigment: FloatArray, relief: float, relief_lips: float, brows: float
) -> _Blend:
    copy, sigma = own.copy, _FINE * own.copy.interocular
    departure = np.clip(paint.departure[own.box], _LEAST_DEPARTURE, _LARGEST_DEPARTURE)
    small = copy.down(departure)
    hair = np.float32(brows) * copy.up(own.brow_hair())
    keep = np.float32(relief) + np.float32(relief_lips - relief) * own.lips
    return _Blend(
        departure=departure,
        broad=copy.up(gaussian(channel_mean(small), sigma)),
        on_lips=copy.up(normalized(small, copy.down(own.lips), sigma, 1e-3)),
        weight=weight,
        sheer=weight * (1 - copy.up(own.worn(small))),
        opacity=paint.opacity[own.box] * weight,
        lips=own.lips,
        taken=np.float32(relief_lips) * own.lips,
        keep=keep * (1 - hair),
        hair=hair,
        own_broad=copy.up(gaussian(own.log, sigma)),
        skin_log=copy.up(own.skin_log),
        pigment=pigment,
        light=copy.up(own.light),
    )


def _continued(paint: Paint, core: Mask, face: Mask, landmarks: Landmarks) -> tuple[Paint, Mask]:
    """The layer continued over the rest of the face from where it is known, and where it may go now."""
    import cv2

    copy = face_scale(landmarks, core.shape, _SPREAD_RESOLUTION)
    known, unit = copy.down(core), copy.interocular
    layer = np.dstack([copy.down(paint.departure), copy.down(paint.opacity)]) * known[..., None]
    layer = np.dstack([layer, known])
    total = gaussian(layer, 0.05 * unit) + np.float32(0.01) * gaussian(layer, 0.3 * unit)
    spread = copy.up(np.asarray(total[..., :4] / np.maximum(total[..., 4:], np.float32(1e-6)), np.float32))
    depth = cv2.distanceTransform((copy.down(face) > 0.5).astype(np.uint8), cv2.DIST_L2, 5)
    inside = copy.up(smoothstep(np.asarray(depth / max(_EDGE * unit, 1), np.float32))) * np.float32(paint.greasepaint)
    # Only what is connected by knowledge: far from any known pixel nothing is continued.
    inside *= np.clip(copy.up(np.asarray(total[..., 4], np.float32)) * 400, 0, 1)
    departure = spread[..., :3] + in_three_channels(core) * (paint.departure - spread[..., :3])
    opacity = spread[..., 3] + core * (paint.opacity - spread[..., 3])
    return replace(paint, departure=departure, opacity=np.clip(opacity, 0, 1)), np.maximum(core, inside)
