"""The makeup that a face wears, as a layer: what departs from its bare skin, and how opaque that is.

Shadows and wrinkles keep the color of skin, and paint has another one: so outside of eyes and lips it is the color that
is looked at, in logarithms, where a darker light changes nothing. At eyes and lips darkness counts as well, because
liner is black. A departure within the skin's own variation is none; one just beyond it is sheer and filters the light
of the skin below; a large one is opaque and hides it.
"""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.blur import gaussian
from graphface.nodes.bounding_box import Box, bounding_box
from graphface.nodes.color import channel_mean, in_three_channels
from graphface.nodes.disc import disc
from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.makeup.bare_skin import bare_color
from graphface.nodes.makeup.brow_hair import brow_hair
from graphface.nodes.smoothstep import smoothstep
from graphface.nodes.strips import by_strips
from graphface.nodes.types import BareSkin, Features, FloatArray, Image, Landmarks, Mask, Paint, Surface

Share = Annotated[float, Field(ge=0, le=1)]


_FLOOR = np.float32(0.02)
"""Added to colors before the logarithm."""


_NOSTRILS = ((98, 97, 2, 94, 19, 44, 115, 48, 64), (327, 326, 2, 94, 19, 274, 344, 278, 294))
"""FaceMesh points around the nostrils: dark, and not by paint."""


_TOP, _CHIN = 10, 152
"""FaceMesh points at the top of the forehead and at the chin."""


_ABOVE = 0.15
"""How far above the hair of a brow paint is continued from, in inter-ocular distances."""


_SKIN_VARIES = (0.035, 0.08)
"""Bounds of the departure of chroma, in natural logarithms, that is still skin; between them 2 deviations of it."""


_UNEVEN, _DISTRUST = 0.06, 2.5
"""Deviation of chroma from which on a face is lit in several colors, or so hard that its shadows have another color
than its lights; what is still skin then grows by so much of the rest. Portraits under soft light stay below it."""


_DARK_AT_EYES, _DARK_ELSEWHERE = 0.22, 0.92
"""Natural logarithms of darkness that are still shadow."""


_HIDES, _LEAST_HIDDEN = 0.25, 0.5
"""By how much darkness, in natural logarithms, lessens the opacity of a color, and down to which share."""


_FAINT = 0.1
"""Departure beyond the skin's own variation below which paint fades out, in natural logarithms: shine, warm shadows."""


_GRAIN = 0.008
"""Sigma, in inter-ocular distances, of the Gaussian under which pixels are compared with bare skin."""


_GAP = 0.02
"""Radius, in inter-ocular distances, of gaps in paint that are closed: glitter on it, strokes."""


_TURNED, _FACING = 0.2, 0.45
"""z of the normal at which the face turns out of sight, where hair and background show, and from which on it counts."""


@node("makeup.paint")
def paint(
    photo: Image,
    bare: BareSkin,
    visible: Mask,
    surface: Surface,
    features: Features,
    landmarks: Landmarks,
    *,
    opaque: Annotated[float, Field(gt=0, le=2)] = 0.36,
    opaque_lips: Annotated[float, Field(gt=0, le=2)] = 0.35,
    brows: Share = 0.0,
    resolution: Annotated[int, Field(ge=16, le=256)] = 100,
) -> Paint:
    """The layer of makeup on a face, 0 off the face and in the openings of eyes and mouth.

    Args:
        bare: of `makeup.bare_skin`. visible: where the photo shows the face and nothing before it.
        surface, features, landmarks: of the same photo.
        opaque: departure from bare skin, in natural logarithms, from which on paint hides what is below;
            opaque_lips: that of lips, where even bare ones depart.
        brows: share of the hair of the brows that counts as paint. Where it does not, what is painted around goes on.
        resolution: pixels per inter-ocular distance of the copy on which the layer is looked for.
    """
    opacity = np.zeros_like(visible)
    departure = np.zeros_like(photo.pixels)
    skin = bare_color(bare, surface)
    box = bounding_box(np.minimum(visible, surface.coverage) > 0, margin=round(0.1 * landmarks.interocular))
    if box is None:
        return Paint(opacity, departure, skin)
    copy = face_scale(landmarks, visible[box].shape, resolution)
    found = _Layer(copy, box, photo, bare, features, landmarks)
    amount, hides = found.amounts()
    share, opaqueness = found.shares(amount, hides, opaque, opaque_lips)
    there = copy.down(visible[box] * np.clip(2 * surface.coverage[box] - 1, 0, 1))
    facing = np.clip((copy.down(surface.normals[box][..., 2]) - _TURNED) / (_FACING - _TURNED), 0, 1)
    there = np.asarray(there * facing, np.float32)
    hair = np.asarray(_grown(found.hair(), 0.018 * copy.interocular) * (1 - brows), np.float32)
    layer = np.dstack([found.departure * share[..., None], opaqueness])
    # What crosses a brow is seen above it; eye shadow ends below.
    beside = there * (hair < 0.05) * (found.light > -_DARK_ELSEWHERE)
    filled = _filled(layer, beside * found.above(hair), copy.interocular)
    closed = 1 - np.clip(1.3 * features.eyes[box], 0, 1)
    on = np.asarray(copy.up(there) * closed, np.float32)
    hair, share, opaqueness = copy.up(hair), copy.up(share), copy.up(opaqueness)
    smooth, filled = copy.up(found.smooth), copy.up(filled)
    opacity[box] = (opaqueness + hair * (filled[..., 3] - opaqueness)) * on * np.float32(bare.colorful)
    pixels, color, into = photo.pixels[box], bare.color[box], departure[box]
    lightness = copy.up(found.lightness(amount))

    def strip(rows: slice) -> None:
        # Sheer paint is smooth: the pores below it are the skin's.
        fine = in_three_channels(np.clip(2 * opaqueness[rows], 0, 1))
        seen = smooth[rows] + fine * (pixels[rows] - smooth[rows])
        values = _log(seen) - _log(color[rows])
        light = in_three_channels(channel_mean(values))
        values = (values - light) * in_three_channels(share[rows]) + light * in_three_channels(
            np.minimum(share[rows], np.maximum(lightness[rows], opaqueness[rows]))
        )
        values += in_three_channels(hair[rows]) * (filled[rows][..., :3] - values)
        into[rows] = values * in_three_channels(on[rows])

    by_strips(strip, pixels.shape)
    return Paint(opacity, departure, skin, bare.greasepaint)


def _grown(mask: FloatArray, radius: float) -> FloatArray:
    """A soft mask grown by a radius in pixels."""
    import cv2

    grown = np.asarray(cv2.dilate(mask, disc(max(1, radius))), np.float32)
    return np.asarray(np.clip(1.2 * gaussian(grown, 0.6 * radius), 0, 1), np.float32)


def _log(values: FloatArray) -> FloatArray:
    import cv2

    return np.asarray(cv2.log(np.maximum(values, 0) + _FLOOR), np.float32)


class _Layer:
    """The layer on a small copy of the face."""

    def __init__(
        self, copy: FaceScale, box: Box, photo: Image, bare: BareSkin, features: Features, landmarks: Landmarks
    ) -> None:
        self.unit = copy.interocular
        self.bare = bare
        self.smooth = gaussian(copy.down(photo.pixels[box]), _GRAIN * self.unit)
        self.departure = _log(self.smooth) - _log(copy.down(bare.color[box]))
        self.light = channel_mean(self.departure)
        self.chroma = np.asarray(np.linalg.norm(self.departure - self.light[..., None], axis=2), np.float32)
        self.eyes, self.lids, self.lips, self.brows = (
            copy.down(getattr(features, name)[box]) for name in ("eyes", "lids", "lips", "brows")
        )
        down = np.nan_to_num(landmarks.points[_CHIN, :2] - landmarks.points[_TOP, :2])
        self.down = down / max(float(np.linalg.norm(down)), 1e-6)
        self.may_wear = (1 - self._nostrils(landmarks, box, copy)) * (1 - np.clip(1.3 * self.eyes, 0, 1))
        around = _dilated(self.eyes, 0.13 * self.unit)
        self.at_eyes = np.clip(gaussian(around, 0.04 * self.unit) + self.lids, 0, 1)
        at_lips = gaussian(_dilated(self.lips, 0.02 * self.unit), 0.01 * self.unit)
        self.at_lips = np.clip(1.5 * np.maximum(self.lips, at_lips), 0, 1)

    def amounts(self) -> tuple[FloatArray, FloatArray]:
        """How far each pixel departs from bare skin by paint, and how far by what hides skin, natural logarithms.

        What is dark needs not hide skin: it darkens any. So the soft edge of liner shows nothing of the wearer's skin.
        """
        tolerance = float(np.clip(2 * self.bare.deviation, *_SKIN_VARIES))
        tolerance += _DISTRUST * max(self.bare.deviation - _UNEVEN, 0)
        shadow = _DARK_AT_EYES + (_DARK_ELSEWHERE - _DARK_AT_EYES) * (1 - self.at_eyes)
        color = np.maximum(self.chroma - tolerance, 0) * self.may_wear
        amount = np.hypot(color, np.maximum(-self.light - shadow, 0) * self.may_wear)
        hides = color * np.clip(1 + _HIDES * np.minimum(self.light, 0), _LEAST_HIDDEN, 1)
        on_lips = np.hypot(self.chroma, self.light)
        return self._closed(amount, on_lips), self._closed(hides, on_lips)

    def _closed(self, amount: FloatArray, on_lips: FloatArray) -> FloatArray:
        import cv2

        amount = np.asarray(amount + self.at_lips * (np.maximum(amount, on_lips) - amount), np.float32)
        closed = cv2.morphologyEx(amount, cv2.MORPH_CLOSE, disc(max(1, _GAP * self.unit)))
        return np.asarray(np.maximum(amount, closed * self.may_wear), np.float32)

    def shares(
        self, amount: FloatArray, hides: FloatArray, opaque: float, opaque_lips: float
    ) -> tuple[FloatArray, FloatArray]:
        """Share of the departure that is paint, and its opacity."""
        whole = np.hypot(self.chroma, 0.5 * self.light)
        share = np.clip(amount / np.maximum(whole, 1e-3), 0, 1).astype(np.float32)
        share *= smoothstep(np.asarray(amount / _FAINT + self.at_lips, np.float32))
        near = np.clip(1.6 * gaussian(share, _GAP * self.unit) - 0.1, 0, 1) * self.may_wear
        share = np.maximum(share, near)
        opacity = smoothstep(np.asarray(hides / np.where(self.at_lips > 0.5, opaque_lips, opaque), np.float32))
        least = np.float32(self.bare.greasepaint)
        return np.asarray(np.maximum(share, least), np.float32), np.asarray(np.maximum(opacity, least), np.float32)

    def lightness(self, amount: FloatArray) -> FloatArray:
        """Share of the departure of lightness that may be paint even where it is sheer: at eyes and lips."""
        return np.asarray(np.maximum(self.at_eyes, self.at_lips) * (amount > 0), np.float32)

    def hair(self) -> FloatArray:
        """Hair of the brows."""
        return brow_hair(self.smooth, self.departure, self.brows, self.eyes, self.unit)

    def above(self, hair: FloatArray) -> FloatArray:
        """1 where there is hair of a brow within a short distance down the face, else 0."""
        import cv2

        reach = max(1, round(_ABOVE * self.unit))
        kernel = np.zeros((2 * reach + 1,) * 2, np.uint8)
        tip = np.round(reach * (1 + self.down)).astype(int)
        cv2.line(kernel, (reach, reach), (int(tip[0]), int(tip[1])), 1)
        return np.asarray(cv2.dilate((hair > 0.5).astype(np.float32), kernel), np.float32)

    def _nostrils(self, landmarks: Landmarks, box: Box, copy: FaceScale) -> Mask:
        import cv2

        drawn = np.zeros(copy.size, np.uint8)
        origin = np.array([box[1].start, box[0].start])
        for outline in _NOSTRILS:
            points = (np.nan_to_num(landmarks.points[list(outline), :2]) - origin) * copy.scale
            cv2.fillConvexPoly(drawn, cv2.convexHull(np.round(points).astype(np.int32)), 1)
        return np.clip(gaussian(_dilated(drawn, 0.03 * self.unit), 0.02 * self.unit), 0, 1)


def _dilated(mask: NDArray[Any], radius: float) -> FloatArray:
    """The mask's inside, 1 above 0.3, grown by a radius in pixels."""
    import cv2

    return np.asarray(cv2.dilate((mask > 0.3).astype(np.float32), disc(max(1, radius))), np.float32)


def _filled(values: FloatArray, weight: FloatArray, unit: float) -> FloatArray:
    """The values continued from where they have weight, near ones first (normalized convolution)."""
    weighted = np.dstack([values * weight[..., None], weight])
    total = np.zeros_like(weighted)
    for sigma, share in ((0.03, 1.0), (0.08, 0.05)):
        total += np.float32(share) * gaussian(weighted, sigma * unit)
    return np.asarray(total[..., :-1] / np.maximum(total[..., -1:], np.float32(1e-5)), np.float32)
