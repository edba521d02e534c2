"""The paper's three criteria for transferred makeup, as figures: faithfulness, realism, predictability."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from graphface import Evaluator, GraphfaceError, load
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.bench.pair_cost import transfer_ms
from graphface.nodes.bench.transfer_truth import reinhard
from graphface.nodes.color import channel_mean
from graphface.nodes.face_outlines import EYES, LIPS, MOUTH, NOSE
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
    distances; `floor`: that of the input in the reference's color statistics, where nothing has moved, so that it is
    the detector's own. `similarity`: SSIM of locally equalized intensity around them, result against input.
    `seam`: mean gradient along the edge of the painted face over the input's own there; 1 is no seam.
    `albedo_before`, `albedo_after`: mean distance of the regions' median albedo to the reference's.
    `milliseconds` of CPU for the transfer, both photos represented.
    """

    photo: str
    reference: str
    shift: float
    floor: float
    similarity: float
    seam: float
    albedo_before: float
    albedo_after: float
    milliseconds: float


@dataclass(frozen=True)
class Refused:
    """A pair that cannot be made, and why."""

    photo: str
    reference: str
    reason: str


def criteria(photos: Sequence[Path], references: Sequence[Path]) -> Iterator[Criteria | Refused]:
    """Every photo under every reference by makeup.yaml."""
    evaluator, graph = MeteredEvaluator(), load("makeup")
    for photo in photos:
        for reference in references:
            try:
                made = graph.run(list(_ASKED), evaluator=evaluator, photo=photo, reference=reference)
                yield measured(photo.name, reference.name, made, transfer_ms(evaluator, graph))
            except GraphfaceError as error:
                yield Refused(photo.name, reference.name, str(error).partition("\n")[0])


def measured(photo: str, reference: str, made: Mapping[str, Any], milliseconds: float) -> Criteria:
    """The criteria of one run of makeup.yaml that has the outputs above."""
    before, after, features = made["pair.working"], made["image"], made["pair.features"]
    albedo, landmarks = made["pair.reference_albedo"], made["pair.landmarks"]
    recolored = reinhard(before, made["pair.reference_working"])
    return Criteria(
        photo=photo,
        reference=reference,
        shift=landmark_shift(landmarks, found_again(after)),
        floor=landmark_shift(landmarks, found_again(recolored)),
        similarity=feature_similarity(before.pixels, after.pixels, features, landmarks),
        seam=seam(before.pixels, after.pixels, made["core"]),
        albedo_before=albedo_distance(made["pair.albedo"], albedo, features, made["core"]),
        albedo_after=albedo_distance(_chromaticity(after.pixels), albedo, features, made["core"]),
        milliseconds=milliseconds,
    )


def found_again(picture: Image) -> Landmarks:
    """The landmarks of a result, found as those of the photo were."""
    found: Landmarks = load("represent").run(["landmarks"], evaluator=Evaluator(), photo=picture)["landmarks"]
    return found


def landmark_shift(before: Landmarks, after: Landmarks) -> float:
    """Mean distance between the landmarks at eyes, nose and mouth, in inter-ocular distances of `before`."""
    apart = np.linalg.norm(after.points[_FEATURE_POINTS, :2] - before.points[_FEATURE_POINTS, :2], axis=1)
    return float(apart.mean() / max(before.interocular, 1e-3))


def feature_similarity(before: FloatArray, after: FloatArray, features: Features, landmarks: Landmarks) -> float:
    """SSIM around eyes, nose and mouth of intensity without local mean and contrast: shape, not color."""
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
    """Mean distance between the regions' median colors: lips, lids, cheeks and the skin as a whole."""
    distances = []
    for region in (features.lips, features.lids, features.cheeks, np.ones_like(core)):
        where = (region > 0.5) & (core > 0.5)
        if where.any():
            difference = np.median(albedo[where], axis=0) - np.median(reference[where], axis=0)
            distances.append(float(np.linalg.norm(difference)))
    return float(np.mean(distances)) if distances else 0.0


def _chromaticity(pixels: FloatArray) -> FloatArray:
    """Color over its intensity: the paper's albedo."""
    return np.asarray(pixels / np.maximum(channel_mean(pixels)[..., None], 0.15), np.float32)
