"""A face as it would look with even skin that wears nothing: a smooth field with few parameters.

Even skin under a smooth light needs little: the logarithm of a photo is a constant, a linear function of the normal
(the first-order light of the paper) and a quadratic one of the position, for each channel. It is fitted with weights
that ignore what departs from it (Tukey's biweight). So paint, wrinkles and shine hardly move the field, and the
departure from it shows them. A face may be painted more than half: what has the color of skin counts first.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.color import lab
from graphface.nodes.face_scale import FaceScale, face_scale
from graphface.nodes.types import BareSkin, Features, FloatArray, Image, Landmarks, Mask, Segmentation, Surface

_FLOOR = 0.02
"""Added to colors before the logarithm."""


_DARKEST, _BRIGHTEST = 0.02, 1.05
"""Of the field: far from the pixels that it was fitted to a quadratic function may be anything."""


_LEAST_PIXELS = 40
"""Of skin on the copy; with fewer the field is a constant."""


_RIDGE = np.array([1e-6, 0.01, 0.01, 0.01, 0.01, 0.01, 0.05, 0.05, 0.05])
"""Of constant, normal, position and squared position, relative to the number of pixels."""


_ROUNDS, _FIRST_ROUNDS = 10, 3


_COUNTED = 20_000
"""Pixels of a median, about."""


_LEAST_DEVIATION = 0.012
"""Natural logarithms."""


_HUES, _LEAST_CHROMA, _LARGEST_CHROMA = (20.0, 78.0), 6.0, 58.0
"""Of skin in CIE Lab, hue in degrees: on 26 portraits of all skin tones the medians are 25 to 66, and 6 to 36."""


_GREY, _TINTED = 6.0, 13.0
"""Chroma of the strongest colors of a face up to which a photo is black and white, and up to which it may be a tinted
one, whose pallor is no greasepaint; from twice that on it certainly is neither. Pale faces have 13 and more."""


_OFF_SKIN = 1.5
"""Distance from those in the plane of a and b at which a pixel counts 1/e."""


_PAINTED, _UNPAINTED = 0.20, 0.35
"""Share of pixels with the color of skin up to which a face is greasepaint, and from which on it is not."""


@node("makeup.bare_skin")
def bare_skin(
    photo: Image,
    skin: Mask,
    labels: Segmentation,
    surface: Surface,
    features: Features,
    landmarks: Landmarks,
    *,
    resolution: Annotated[int, Field(ge=8, le=128)] = 48,
) -> BareSkin:
    """The smooth field of a face's bare skin, over the whole picture.

    Args:
        skin: where the photo shows skin, of `makeup.loose_hair` or `makeup.skin`.
        labels, surface, features, landmarks: of the same photo. Brows, lids, lips and openings are left out of the fit.
        resolution: pixels per inter-ocular distance of the copy that is fitted.

    Returns:
        A constant field, with a warning, where too little skin is seen.
    """
    copy = face_scale(landmarks, skin.shape, resolution)
    pixels = np.maximum(copy.down(photo.pixels), 0)
    parts = features.any_of("eyes", "mouth", "lips", "lids", "brows")
    usable = (copy.down(np.minimum(skin, surface.coverage)) > 0.9) & (copy.down(np.maximum(parts, labels.hair)) < 0.08)
    covered = copy.down(surface.coverage) > 0.5
    values = lab(pixels)
    chroma = np.hypot(values[..., 1], values[..., 2])
    strongest = float(np.quantile(chroma[covered] if covered.any() else chroma, 0.95))
    colorful = float(np.clip(strongest / _GREY - 1, 0, 1))
    if usable.sum() < _LEAST_PIXELS:
        warn("makeup.bare_skin: too little skin is seen; its color is taken as constant")
        mean = pixels[covered].mean(axis=0) if covered.any() else pixels.reshape(-1, 3).mean(axis=0)
        color = np.tile(np.maximum(mean, np.float32(_DARKEST)).astype(np.float32), (*skin.shape, 1))
        return BareSkin(color, 0.03, 0.0, colorful)
    likely = _skin_likelihood(values)[usable]
    share = float(likely.mean())
    greasepaint = float(np.clip((_UNPAINTED - share) / (_UNPAINTED - _PAINTED), 0, 1))
    greasepaint *= float(np.clip(strongest / _TINTED - 1, 0, 1))
    weight = np.maximum(likely, max(greasepaint, 0.02)).astype(np.float64)
    basis = _basis(copy, copy.down(surface.normals), landmarks)
    field, deviation = _fitted(np.log(pixels + _FLOOR), basis, usable, weight)
    field = np.clip(field, np.log(_DARKEST + _FLOOR), np.log(_BRIGHTEST + _FLOOR)).astype(np.float32)
    return BareSkin(copy.up(np.exp(field) - np.float32(_FLOOR)), deviation, greasepaint, colorful)


def bare_color(bare: BareSkin, surface: Surface) -> FloatArray:
    """Median color of bare skin under the light of the face's middle, float32 (3,); the picture's where no face is."""
    covered = bare.color[surface.coverage > 0.5]
    seen = covered if len(covered) else bare.color.reshape(-1, 3)
    return np.asarray(np.median(seen[:: max(1, len(seen) // _COUNTED)], axis=0), np.float32)


def _skin_likelihood(lab: FloatArray) -> FloatArray:
    """1 for colors that skin has, falling with the distance from them, H x W."""
    chroma = np.hypot(lab[..., 1], lab[..., 2])
    hue = np.degrees(np.arctan2(lab[..., 2], lab[..., 1]))
    beyond = np.clip(np.maximum(_HUES[0] - hue, hue - _HUES[1]), 0, 90)
    distance = np.maximum(_LEAST_CHROMA - chroma, 0) + np.maximum(chroma - _LARGEST_CHROMA, 0)
    distance += np.minimum(chroma, _LARGEST_CHROMA) * np.sin(np.radians(beyond))
    return np.asarray(np.exp(-np.square(distance / _OFF_SKIN)), np.float32)


def _basis(copy: FaceScale, normals: FloatArray, landmarks: Landmarks) -> NDArray[np.float64]:
    """1, normal, position and its products, in inter-ocular distances from between the eyes: h x w x 9."""
    height, width = copy.size
    middle = np.nan_to_num(landmarks.points[:, :2].mean(axis=0)) * copy.scale
    y, x = np.mgrid[:height, :width].astype(np.float64)
    y, x = (np.clip((v - m) / copy.interocular, -2, 2) for v, m in ((y, middle[1]), (x, middle[0])))
    ones = np.ones_like(x)
    return np.stack([ones, *np.moveaxis(normals.astype(np.float64), 2, 0), x, y, x * x, x * y, y * y], axis=2)


def _fitted(
    log: FloatArray, basis: NDArray[np.float64], usable: NDArray[np.bool_], prior: NDArray[np.float64]
) -> tuple[NDArray[np.float64], float]:
    """The field h x w x 3 by iteratively reweighted least squares, and the deviation of chroma from it.

    A residual's difference between channels counts in full and its mean by half: paint has a color, a wrinkle is dark.
    """
    offset = basis[usable].mean(axis=0)
    offset[0] = 0
    known, values = basis[usable] - offset, log[usable].astype(np.float64)
    middle = np.average(values, axis=0, weights=prior)
    weight = prior
    for round_ in range(_ROUNDS):
        weighted = known * weight[:, None]
        normal_matrix = weighted.T @ known + np.diag(_RIDGE) * max(float(weight.sum()), 1e-9)
        coefficients = np.linalg.solve(normal_matrix, weighted.T @ (values - middle))
        residual = values - middle - known @ coefficients
        light = residual.mean(axis=1)
        chroma = np.linalg.norm(residual - light[:, None], axis=1)
        error = np.hypot(1.5 * chroma, 0.5 * light)
        inliers = weight >= 0.3 * weight.mean()
        scale = max(1.4826 * float(np.median(error[inliers])), _LEAST_DEVIATION)
        # Cauchy's weights first: Tukey's depend on where they start
        cauchy, tukey = 1 / (1 + np.square(error / (2 * scale))), np.clip(1 - np.square(error / (4 * scale)), 0, 1) ** 2
        weight = prior * (cauchy if round_ < _FIRST_ROUNDS else tukey)
        weight = weight if weight.any() else prior
    counted = weight >= 0.3 * weight.max()
    deviation = max(1.4826 * float(np.median(chroma[counted])), _LEAST_DEVIATION)
    return middle + (basis - offset) @ coefficients, deviation
