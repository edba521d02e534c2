"""Transfers between photographs as folders that a scorer of visible defects reads, and figures that need no truth.

PHOTO_from_REFERENCE/photo.png, result.png, points.npy, face.png, hair.png, background.png, warped.png, known.png
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from graphface import Evaluator, Graph, GraphfaceError, MemoryTier, warn
from graphface.nodes.bench.relit_looks import write_case
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean, in_space
from graphface.nodes.image.resize import resize
from graphface.nodes.io.image_read import read_image
from graphface.nodes.io.image_write import write_picture
from graphface.nodes.types import Features, FloatArray, Image, Landmarks, Mask

_ASKED = (
    *("image", "pair.working", "pair.landmarks", "pair.features", "pair.reference_warped", "pair.correspondence"),
    *("pair/face.labels", "pair/warped_skin"),
)

_CHEEKS, _CHEEK_RADIUS = (50, 280), 0.12
"""FaceMesh points in the middle of the cheeks; inter-ocular distances."""

_FLOOR = 0.05
"""Added to intensity before the logarithm."""


@dataclass(frozen=True)
class TransferLook:
    """One pair.

    Attributes:
        skin: CIE76 difference of the cheeks to the photo's.
        lips: degrees of hue between the result's lips and the reference's; NaN where those have next to none.
        brow: share of the difference between the two faces' brows that arrived; 0 keeps the photo's own.
        eyes: share of the reference's departure from its skin around the eyes that arrived.
        outside: mean change of hair and background, in levels of 255.
        untouched: share of the face label with the photo's own pixels, to a level.
    """

    photo: str
    reference: str
    skin: float
    lips: float
    brow: float
    eyes: float
    outside: float
    untouched: float


def transfer_looks(
    photos: Sequence[Path], references: Sequence[Path], graph: Graph, out: Path, long_side: int, every: int = 1
) -> Iterator[TransferLook]:
    """Every photo under every reference; a pair that cannot be made is named.

    Args:
        graph: makeup or transfer. out: folder for the cases.
        long_side: larger photos are scaled down to this many pixels. every: take every n-th pair.
    """
    evaluator = Evaluator(memory=MemoryTier(), threads=1)
    asked = [*_ASKED, *(["mask"] if "mask" in graph.outputs else [])]
    pairs = [(photo, reference) for photo in photos for reference in references]
    for photo, reference in pairs[::every]:
        try:
            given = {
                name: resize(read_image(f), long_side=long_side)
                for name, f in zip(("photo", "reference"), (photo, reference), strict=True)
            }
            made = graph.run(asked, evaluator=evaluator, **given)
        except GraphfaceError as problem:
            warn(f"{photo.name} from {reference.name} is left out: {str(problem).splitlines()[0]}")
            continue
        folder = out / f"{photo.stem}_from_{reference.stem}"
        _write(folder, made)
        yield measured(photo.stem, reference.stem, made)


def _write(folder: Path, made: Mapping[str, Any]) -> None:
    photo: Image = made["pair.working"]
    write_case(folder, photo, made["image"], made["pair.landmarks"], made["pair/face.labels"])
    maps = {"warped": np.clip(made["pair.reference_warped"].pixels, 0, 1), "known": _known(made)}
    if "mask" in made:
        maps["mask"] = made["mask"]
    for name, values in maps.items():
        write_picture(np.asarray(np.rint(255 * values), np.uint8), folder / f"{name}.png")


def _known(made: Mapping[str, Any]) -> Mask:
    known: Mask = np.minimum(made["pair.correspondence"].known, made["pair/warped_skin"])
    return known


def measured(photo: str, reference: str, made: Mapping[str, Any]) -> TransferLook:
    """The figures of one run that has the outputs above."""
    before, after, warped = (made[name].pixels for name in ("pair.working", "image", "pair.reference_warped"))
    features, landmarks, labels = made["pair.features"], made["pair.landmarks"], made["pair/face.labels"]
    known = _known(made) > 0.5
    changed = np.abs(after - before).mean(axis=2)
    beyond, face = np.maximum(labels.hair, labels.background) > 0.98, labels.face > 0.5
    brows, around = features.brows > 0.3, _around_eyes(features, landmarks)
    return TransferLook(
        photo=photo,
        reference=reference,
        skin=_skin(before, after, landmarks),
        lips=_hue_apart(after, warped, (features.lips > 0.6) & known),
        brow=_arrived(brows & known, *(_darkness(v, features, landmarks) for v in (before, after, warped))),
        eyes=_arrived(around & known, *(_departure(v, features) for v in (before, after, warped))),
        outside=_mean(255 * changed, beyond),
        untouched=_mean((changed < 1 / 255).astype(np.float32), face),
    )


def _mean(values: FloatArray, where: Any) -> float:
    return float(values[where].mean()) if where.any() else float("nan")


def _skin(before: FloatArray, after: FloatArray, landmarks: Landmarks) -> float:
    rows, columns = np.ogrid[: before.shape[0], : before.shape[1]]
    where = np.zeros(before.shape[:2], bool)
    for x, y in landmarks.points[list(_CHEEKS), :2]:
        where |= np.hypot(columns - x, rows - y) < _CHEEK_RADIUS * landmarks.interocular
    if not where.any():
        return float("nan")
    old, new = (_lab(v[where]).mean(axis=0) for v in (before, after))
    return float(np.linalg.norm(new - old))


def _lab(pixels: FloatArray) -> FloatArray:
    scaled = in_space(np.clip(pixels[None], 0, 1).astype(np.float32), "lab")[0]
    return np.asarray(scaled / np.array([0.01, 0.02, 0.02], np.float32), np.float32)


def _hue_apart(after: FloatArray, warped: FloatArray, where: Any) -> float:
    if not where.any():
        return float("nan")
    new, other = (_lab(v[where]).mean(axis=0) for v in (after, warped))
    if np.hypot(*other[1:]) < 8:
        return float("nan")
    turn = np.degrees(np.arctan2(new[2], new[1]) - np.arctan2(other[2], other[1]))
    return float(abs((turn + 180) % 360 - 180))


def _darkness(pixels: FloatArray, features: Features, landmarks: Landmarks) -> FloatArray:
    """Logarithm of intensity against that of the nose and the cheeks, H x W."""
    log = np.log(
        np.maximum(channel_mean(blurred(pixels, max(0.006 * landmarks.interocular, 0.3))), 0) + np.float32(_FLOOR)
    )
    skin = features.any_of("cheeks", "nose") > 0.5
    return np.asarray(log - (np.median(log[skin]) if skin.any() else 0), np.float32)


def _departure(pixels: FloatArray, features: Features) -> FloatArray:
    """Logarithm of color against that of the nose and the cheeks, H x W x 3."""
    log = np.log(np.clip(pixels, 0, 1) + np.float32(_FLOOR))
    skin = features.any_of("cheeks", "nose") > 0.5
    return np.asarray(log - (np.median(log[skin], axis=0) if skin.any() else 0), np.float32)


def _around_eyes(features: Features, landmarks: Landmarks) -> Any:
    lids = blurred(features.lids, max(0.03 * landmarks.interocular, 0.3)) > 0.2
    return lids & (features.eyes < 0.3) & (features.brows < 0.1)


def _arrived(where: Any, *pictures: FloatArray) -> float:
    """Regression of the change on the difference that was to arrive; pictures before, after, and the wanted one."""
    if not where.any():
        return float("nan")
    before, after, wanted = (picture[where] for picture in pictures)
    asked, came = wanted - before, after - before
    return float((asked * came).sum() / max(float(np.square(asked).sum()), 1e-6))
