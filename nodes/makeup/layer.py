"""A layer of makeup over a face that keeps its own skin."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import gaussian
from graphface.nodes.bounding_box import bounding_box
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.face_scale import FaceScale, face_scale
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
    copy = face_scale(landmarks, core[box].shape, 100)
    skin_lightness = _lightness(bare, surface)
    own = _Own(copy, photo.pixels[box], bare.color[box], skin_lightness)
    departure = np.clip(paint.departure[box], _LEAST_DEPARTURE, _LARGEST_DEPARTURE)
    worn = copy.up(own.worn(copy.down(departure)))
    eyes, around_brows = (copy.down(getattr(features, name)[box]) for name in ("eyes", "brows"))
    hair = np.float32(brows) * copy.up(brow_hair(own.pixels, own.departure, around_brows, eyes, copy.interocular))
    small = copy.down(departure)
    own_broad, broad = (copy.up(gaussian(v, _FINE * copy.interocular)) for v in (own.log, channel_mean(small)))
    on_lips = copy.up(_within(small, copy.down(features.lips[box]), _FINE * copy.interocular))
    facing = np.clip((surface.normals[box][..., 2] - _TURNED) / (_FACING - _TURNED), 0, 1)
    weight = np.asarray(core[box] * facing * (1 - np.minimum(features.openings[box], 1)), np.float32)
    darker = np.clip(skin_lightness / max(float(paint.skin.mean()), 1e-3), _LEAST_EXPOSURE, _LARGEST_LIGHT)
    pigment = paint.skin * np.float32(darker**exposure)
    light, skin_log = (copy.up(np.asarray(v, np.float32)) for v in (own.light, own.skin_log))
    keep = np.float32(relief) + np.float32(relief_lips - relief) * features.lips[box]
    keep *= 1 - hair
    pixels, opacity, lips = photo.pixels[box], paint.opacity[box], features.lips[box]
    result = photo.pixels.copy()
    into = result[box]

    def strip(rows: slice) -> None:
        lip = lips[rows]
        # Gloss and lines of the other lips have a color of their own, and go as a whole.
        put_on = departure[rows] - in_three_channels(np.float32(relief_lips) * lip) * (departure[rows] - on_lips[rows])
        log = np.log(np.maximum(channel_mean(pixels[rows]), 0) + _FLOOR)
        fine = log - own_broad[rows] - (1 - lip) * (channel_mean(departure[rows]) - broad[rows])
        fine = np.clip(fine, -_LARGEST_FINE, _LARGEST_FINE)
        through = np.exp(keep[rows] * fine + hair[rows] * np.clip(log - skin_log[rows], -2, 0))
        a = opacity[rows] * weight[rows]
        sheer = np.exp(put_on * in_three_channels(weight[rows] * (1 - worn[rows])))
        opaque = np.exp(put_on) * pigment * in_three_channels(light[rows] * through)
        painted = pixels[rows] * sheer
        painted += in_three_channels(a) * (opaque - painted)
        there = in_three_channels(((a > 0) | (np.abs(put_on).max(axis=2) * weight[rows] > 0)).astype(np.float32)) > 0
        into[rows] = np.where(there, np.clip(painted, 0, 1), pixels[rows])

    by_strips(strip, pixels.shape)
    return photo.with_pixels(result)


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


def _within(values: FloatArray, mask: FloatArray, sigma: float) -> FloatArray:
    """The values under a Gaussian, of the pixels in the mask alone."""
    sums = gaussian(np.dstack([values * mask[..., None], mask]), sigma)
    return np.asarray(sums[..., :3] / np.maximum(sums[..., 3:], np.float32(1e-3)), np.float32)


class _Own:
    """What the photo shows, on a small copy of the painted part of the face."""

    def __init__(self, copy: FaceScale, pixels: FloatArray, color: FloatArray, lightness: float) -> None:
        self.pixels, color = copy.down(pixels), copy.down(color)
        smooth = gaussian(self.pixels, 0.008 * copy.interocular)
        self.departure = np.log(np.maximum(smooth, 0) + _FLOOR) - np.log(np.maximum(color, 0) + _FLOOR)
        self.log = np.log(np.maximum(channel_mean(self.pixels), 0) + _FLOOR)
        mean = np.maximum(channel_mean(color), _FLOOR / 2)
        self.skin_log = np.log(mean + _FLOOR)
        self.light = np.clip(mean / np.float32(max(lightness, 1e-3)), _LEAST_LIGHT, _LARGEST_LIGHT)

    def worn(self, departure: FloatArray) -> FloatArray:
        """Share of a departure that the photo has already, h x w, 0 to 1."""
        along = np.einsum("hwc,hwc->hw", self.departure, departure)
        return np.asarray(np.clip(along / np.maximum(np.square(departure).sum(axis=2), 1e-4), 0, 1), np.float32)


def _lightness(bare: BareSkin, surface: Surface) -> float:
    """Median lightness of the photo's bare skin; of the whole picture where no face is."""
    seen = channel_mean(bare.color)[surface.coverage > 0.5]
    return float(np.median(seen[:: max(1, len(seen) // 20000)] if len(seen) else bare.color))
