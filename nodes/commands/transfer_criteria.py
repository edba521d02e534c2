"""The paper's three criteria for transferred makeup, as figures: faithfulness, realism, predictability."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from graphface import Evaluator, GraphfaceError, MemoryTier, load
from graphface.nodes.color import channel_mean
from graphface.nodes.commands.transfer_truth import reinhard
from graphface.nodes.makeup.features import EYES, LIPS, MOUTH, NOSE
from graphface.nodes.types import Features, FloatArray, Image, Landmarks, Mask

_FEATURE_POINTS = sorted({*EYES[0], *EYES[1], *LIPS, *MOUTH, *NOSE})
_ASKED = (
    "image",
    "core",
    "pair.working",
    "pair.reference_working",
    "pair.landmarks",
    "pair.albedo",
    "pair.reference_albedo",
    "pair.features",
)


@dataclass(frozen=True)
class Criteria:
    """One pair.

    `shift`: mean movement of the landmarks of eyes, nose and mouth, found again on the result, in inter-ocular
    distances; `floor`: that of the input in the reference's colour statistics, where nothing has moved, so that it is
    the detector's own. `similarity`: SSIM of locally equalized intensity around them, result against input.
    `seam`: mean gradient along the edge of the painted face over the input's own there; 1 is no seam.
    `albedo_before`, `albedo_after`: mean distance of the regions' median albedo to the reference's.
    """

    photo: str
    reference: str
    shift: float
    floor: float
    similarity: float
    seam: float
    albedo_before: float
    albedo_after: float


def criteria(photos: Sequence[Path], references: Sequence[Path]) -> Iterator[Criteria | tuple[str, str, str]]:
    """Every photo under every reference; (photo, reference, reason) where a pair cannot be made."""
    evaluator, graph = Evaluator(memory=MemoryTier()), load("makeup")
    for photo in photos:
        for reference in references:
            try:
                made = graph.run(list(_ASKED), evaluator=evaluator, photo=photo, reference=reference)
                yield measured(photo.name, reference.name, made)
            except GraphfaceError as error:
                yield photo.name, reference.name, str(error).partition("\n")[0]


def measured(photo: str, reference: str, made: Any) -> Criteria:
    """The criteria of one run of makeup.yaml that has the outputs above."""
    before, after, features = made["pair.working"], made["image"], made["pair.features"]
    albedo, landmarks = made["pair.reference_albedo"], made["pair.landmarks"]
    recoloured = reinhard(before, made["pair.reference_working"])
    return Criteria(
        photo=photo,
        reference=reference,
        shift=landmark_shift(before, after, landmarks),
        floor=landmark_shift(before, recoloured, landmarks),
        similarity=feature_similarity(before.pixels, after.pixels, features, landmarks),
        seam=seam(before.pixels, after.pixels, made["core"]),
        albedo_before=albedo_distance(made["pair.albedo"], albedo, features, made["core"]),
        albedo_after=albedo_distance(_chromaticity(after.pixels), albedo, features, made["core"]),
    )


def landmark_shift(before: Image, after: Image, landmarks: Landmarks) -> float:
    """Mean distance between the landmarks of both pictures at eyes, nose and mouth, in inter-ocular distances.

    Both are found by the same detector in the same way; `landmarks` gives the unit.
    """
    from graphface.nodes.landmarks.facemesh import facemesh

    points = [facemesh(picture).points[_FEATURE_POINTS, :2] for picture in (before, after)]
    apart = np.linalg.norm(points[1] - points[0], axis=1)
    return float(apart.mean() / max(landmarks.interocular, 1e-3))


def feature_similarity(before: FloatArray, after: FloatArray, features: Features, landmarks: Landmarks) -> float:
    """SSIM around eyes, nose and mouth of intensity without local mean and contrast: shape, not colour."""
    import cv2
    from skimage.metrics import structural_similarity

    sigma = max(0.1 * landmarks.interocular, 1.0)

    def equalized(pixels: FloatArray) -> FloatArray:
        grey = channel_mean(pixels)
        fine = grey - cv2.GaussianBlur(grey, (0, 0), sigma)
        power = np.maximum(cv2.GaussianBlur(fine * fine, (0, 0), sigma), 0)
        return np.asarray(fine / np.sqrt(power + 1e-3), np.float32)

    one, other = equalized(before), equalized(after)
    where = features.any_of("eyes", "mouth", "nose", "lips") > 0.5
    if not where.any() or min(one.shape) < 7:
        return 1.0
    maps: Any = structural_similarity(one, other, data_range=4, full=True)  # type: ignore[no-untyped-call]
    return float(maps[1][where].mean())


def seam(before: FloatArray, after: FloatArray, core: Mask) -> float:
    """Mean gradient where the painted face ends, after over before (floored by 1/255); 1 where nothing is painted."""
    edge = (core > 0.02) & (core < 0.98)
    if not edge.any():
        return 1.0
    gradients = [np.hypot(*np.gradient(channel_mean(pixels)))[edge].mean() for pixels in (before, after)]
    return float(gradients[1] / max(gradients[0], 1 / 255))


def albedo_distance(albedo: FloatArray, reference: FloatArray, features: Features, core: Mask) -> float:
    """Mean distance between the regions' median colours: lips, lids, cheeks and the skin as a whole."""
    distances = []
    for region in (features.lips, features.lids, features.cheeks, np.ones_like(core)):
        where = (region > 0.5) & (core > 0.5)
        if where.any():
            difference = np.median(albedo[where], axis=0) - np.median(reference[where], axis=0)
            distances.append(float(np.linalg.norm(difference)))
    return float(np.mean(distances)) if distances else 0.0


def _chromaticity(pixels: FloatArray) -> FloatArray:
    """Colour over its intensity: the paper's albedo."""
    return np.asarray(pixels / np.maximum(channel_mean(pixels)[..., None], 0.15), np.float32)
