"""Detail transfer on pairs of photos: the cases that a scorer of visible defects reads, and its three figures.

There is no truth for a face with another's wrinkles. What goes wrong can be seen all the same: a patch that is darker,
brighter or of another color than the skin around, or detail that does not arrive. Each case is a folder:

    PHOTO_REFERENCE/photo.png, result.png, warped.png, known.png, mask.png
                    points.npy, face.png, hair.png, background.png
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import Evaluator, GraphfaceError, UsageError, load, warn
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean
from graphface.nodes.image.encode import encode
from graphface.nodes.io.image_write import write_image, write_picture
from graphface.nodes.relief import filled, logarithm
from graphface.nodes.types import Correspondence, FloatArray, Image, Landmarks, Mask, Segmentation
from graphface.values.writing import beside, make_folder

_ASKED = (
    "image",
    "mask",
    "correspondence",
    "pair.working",
    "pair.landmarks",
    "pair.reference_warped",
    "pair/face.labels",
)

_BROAD, _CHROMA, _FINE = 0.05, 0.02, (0.006, 0.04)
"""Sigmas in inter-ocular distances: of a patch, of a patch of color, and of the band whose arrival is measured."""

_LEAST_PIXELS = 50


@dataclass(frozen=True)
class Pair:
    """Two files, and the regions that are taken; none stands for all that the graph takes."""

    photo: Path
    reference: Path
    take: tuple[str, ...] = ()


@dataclass(frozen=True)
class DetailLook:
    """One pair, over the pixels whose mask is above a half; NaN where there are none.

    `patch`: root mean square of the change broader than 0.05 inter-ocular distances, in % of intensity; `color`: of
    what of the change is color. `delivered`: regression of the new fine detail on the reference's, 0 for nothing, 1 for
    all. The first two are read together with the third: a photo that does not change has no patch.
    """

    photo: str
    reference: str
    patch: float
    color: float
    delivered: float


def read_pairs(file: Path) -> list[Pair]:
    """Lines "photo, reference" or "photo, reference, regions"; paths count from the file's folder.

    Raises:
        UsageError: a line has no reference.
    """
    pairs = []
    with file.open(newline="") as lines:
        for row in csv.reader(lines, skipinitialspace=True):
            if not row or row[0].startswith("#"):
                continue
            if len(row) < 2:
                raise UsageError(f"{file.name}: a line names a photo and a reference, got {row[0]!r}")
            photo, reference = (file.parent / name.strip() for name in row[:2])
            pairs.append(Pair(photo, reference, tuple(" ".join(row[2:]).split())))
    return pairs


def detail_looks(pairs: Iterable[Pair], out: Path, variants: tuple[str, ...] = ()) -> Iterator[DetailLook]:
    """Transfer the detail of every pair, write its case, measure it; a pair that cannot be made is named.

    Args:
        out: folder for the cases.
        variants: of transfer.yaml.
    """
    for pair in pairs:
        graph = load("transfer", variants=variants, set={"mask.take": list(pair.take)} if pair.take else None)
        try:
            made = graph.run(list(_ASKED), evaluator=Evaluator(), photo=pair.photo, reference=pair.reference)
        except GraphfaceError as problem:
            warn(f"{pair.photo.name} with {pair.reference.name} is left out: {str(problem).splitlines()[0]}")
            continue
        photo, result = (encode(made[name], encoding="srgb") for name in ("pair.working", "image"))
        landmarks, mask = made["pair.landmarks"], made["mask"]
        warped = _extended(encode(made["pair.reference_warped"], encoding="srgb"), made["correspondence"], landmarks)
        known = made["correspondence"].known * made["correspondence"].inside
        folder = out / f"{pair.photo.stem}_{pair.reference.stem}"
        _write_case(folder, {"photo": photo, "result": result, "warped": warped}, {"known": known, "mask": mask})
        _write_labels(folder, landmarks, made["pair/face.labels"])
        unit = landmarks.interocular
        yield DetailLook(
            photo=pair.photo.stem,
            reference=pair.reference.stem,
            patch=patch(photo.pixels, result.pixels, mask, unit),
            color=color(photo.pixels, result.pixels, mask, unit),
            delivered=delivered(photo.pixels, result.pixels, warped.pixels, mask * (known > 0.9), unit),
        )


def patch(before: FloatArray, after: FloatArray, mask: Mask, unit: float) -> float:
    """See `DetailLook`. Args: H x W x 3 sRGB in [0, 1]; `unit` is the inter-ocular distance in pixels."""
    return _strength(blurred(_change(before, after), max(_BROAD * unit, 0.3)), mask)


def color(before: FloatArray, after: FloatArray, mask: Mask, unit: float) -> float:
    """See `DetailLook`; arguments as of `patch`."""
    change = _change(before, after)
    return _strength(blurred(change - channel_mean(change)[..., None], max(_CHROMA * unit, 0.3)), mask)


def delivered(before: FloatArray, after: FloatArray, reference: FloatArray, mask: Mask, unit: float) -> float:
    """See `DetailLook`; arguments as of `patch`, `reference` warped to the photo."""
    inside = mask > 0.5
    if np.count_nonzero(inside) < _LEAST_PIXELS:
        return float("nan")
    own, new, other = (_fine(pixels, unit)[inside] for pixels in (before, after, reference))
    wanted, came = other - own, new - own
    return float((wanted * came).sum() / max(float((wanted * wanted).sum()), 1e-9))


def _change(before: FloatArray, after: FloatArray) -> FloatArray:
    return logarithm(np.clip(after, 0, 1)) - logarithm(np.clip(before, 0, 1))


def _strength(change: FloatArray, mask: Mask) -> float:
    inside: NDArray[np.bool_] = mask > 0.5
    if np.count_nonzero(inside) < _LEAST_PIXELS:
        return float("nan")
    return 100 * float(np.sqrt(np.mean(np.square(change[inside]))))


def _fine(pixels: FloatArray, unit: float) -> FloatArray:
    light = logarithm(channel_mean(np.clip(pixels, 0, 1)))
    narrow, wide = (blurred(light, max(sigma * unit, 0.3)) for sigma in _FINE)
    return narrow - wide


def _extended(warped: Image, correspondence: Correspondence, landmarks: Landmarks) -> Image:
    """The warped reference with averages of what is near off the mesh: a black border would count as detail."""
    import cv2

    inside = (cv2.erode(correspondence.inside, np.ones((3, 3), np.uint8)) > 0.9).astype(np.float32)
    spread = filled(warped.pixels, inside, landmarks.interocular)
    return replace(warped, pixels=np.where(inside[..., None] > 0, warped.pixels, spread))


def _write_case(folder: Path, pictures: dict[str, Image], masks: dict[str, Mask]) -> None:
    make_folder(folder)
    for name, image in pictures.items():
        write_image(image, folder / f"{name}.png")
    for name, values in masks.items():
        write_picture(np.asarray(np.rint(255 * np.clip(values, 0, 1)), np.uint8), folder / f"{name}.png")


def _write_labels(folder: Path, landmarks: Landmarks, labels: Segmentation) -> None:
    with beside(folder / "points.npy") as path, path.open("wb") as file:
        np.save(file, landmarks.points)
    _write_case(folder, {}, {part: getattr(labels, part) for part in ("face", "hair", "background")})
