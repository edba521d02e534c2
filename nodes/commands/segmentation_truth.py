"""Segment the path-traced heads, whose labels are known: how far off each choice of matting is, and what it costs.

The truth calls the painted inside of the ears hair; nothing in a photo says so, and it is counted as it stands.
"""

from __future__ import annotations

import time
import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.commands.heads import heads_of
from graphface.nodes.geometry.facemesh import facemesh as build_mesh
from graphface.nodes.io.image_read import read_image
from graphface.nodes.landmarks.facemesh import facemesh as find_landmarks
from graphface.nodes.masks.classify import classify
from graphface.nodes.masks.cue import cue
from graphface.nodes.masks.cued_hair import cued_hair
from graphface.nodes.masks.features import pixel_features
from graphface.nodes.masks.geometric import geometric
from graphface.nodes.masks.hair import hair
from graphface.nodes.masks.label_weights import LabelWeights
from graphface.nodes.masks.density import Model
from graphface.nodes.masks.network import network
from graphface.nodes.matting.closed_form import closed_form
from graphface.nodes.matting.guided import guided
from graphface.nodes.matting.knn import knn
from graphface.nodes.matting.none import none
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import FloatArray, Image, Landmarks, Segmentation

Labeller = Callable[[Image, Landmarks], Segmentation]
Matting = Callable[[Image, Segmentation, Landmarks], Segmentation]

MATTINGS: dict[str, Matting] = {"none": none, "guided": guided, "closed_form": closed_form, "knn": knn}
LABELS = ("face", "hair", "background")


@dataclass(frozen=True)
class Segmented:
    """One head with one choice of matting; figures are by label, in the order of `LABELS`.

    `iou`: intersection over union of the likeliest labels. `boundary`: mean distance between found and true outline,
    both ways, in pixels. `softness`: mean absolute difference of the soft masks. `labels_ms`: the stage up to the
    classifiers; `matting_ms`: from there on; `peak_mb`: most memory that arrays took during matting.
    """

    head: str
    matting: str
    iou: tuple[float, ...]
    boundary: tuple[float, ...]
    softness: tuple[float, ...]
    labels_ms: float
    matting_ms: float
    peak_mb: float


def segment_truth(
    data: Path, mattings: dict[str, Matting] | None = None, label: Labeller | None = None
) -> Iterator[Segmented]:
    """Segment every head of `data`/truth under frontal light with every choice of matting.

    Args:
        label: what finds the labels, before matting; the classifiers by default.

    Raises:
        UnreadableFile: there are no heads at `data`.
    """
    label = label or segment_photo
    heads = heads_of(data, "labels.png")
    for head in heads:
        photo = read_image(head / "frontal.png")
        truth = true_labels(head / "labels.png")
        landmarks = find_landmarks(photo)
        label(photo, landmarks)  # once for nothing: imports and caches are not what is measured
        labels, labels_ms, _ = _measured(lambda p=photo, at=landmarks: label(p, at))  # type: ignore[misc]
        for name, matting in (mattings or MATTINGS).items():
            yield compared(head.name, name, matting, photo, landmarks, labels, truth, labels_ms)


def segment_photo(photo: Image, landmarks: Landmarks, weights: LabelWeights | None = None) -> Segmentation:
    """The stage up to the classifiers, as in graphs/segment.yaml; `weights` of the cue, the shipped ones by default."""
    masks = geometric(photo, landmarks, rasterize(build_mesh(landmarks), photo))
    known = cue(photo, landmarks, weights)
    return classify(pixel_features(photo, landmarks), masks, cued_hair(known, masks), landmarks, photo, known)


def segment_by_cue(photo: Image, landmarks: Landmarks) -> Segmentation:
    """What the classifiers start from."""
    return cue(photo, landmarks)


def segment_by_detector(photo: Image, landmarks: Landmarks, model: Model = "parzen") -> Segmentation:
    """Labels before matting, as in the variant `detector` of graphs/segment.yaml."""
    masks = geometric(photo, landmarks, rasterize(build_mesh(landmarks), photo))
    features = pixel_features(photo, landmarks)
    return classify(features, masks, hair(features, masks, landmarks, model=model), landmarks, photo, model=model)


def segment_by_mixtures(photo: Image, landmarks: Landmarks) -> Segmentation:
    """Labels before matting, as in the variant `mixtures` of graphs/segment.yaml."""
    return segment_by_detector(photo, landmarks, "mixture")


def segment_by_network(photo: Image, landmarks: Landmarks) -> Segmentation:
    """Labels before matting, as in the variant `network` of graphs/segment.yaml."""
    return network(photo, landmarks, geometric(photo, landmarks, rasterize(build_mesh(landmarks), photo)))


LABELLERS: dict[str, Labeller] = {
    "classify": segment_photo,
    "cue": segment_by_cue,
    "detector": segment_by_detector,
    "mixtures": segment_by_mixtures,
    "network": segment_by_network,
}


def true_labels(path: Path) -> FloatArray:
    """labels.png as H x W x 3 in the order of `LABELS`: green is face, red is hair."""
    pixels = read_image(path).pixels
    face, locks = pixels[..., 1], pixels[..., 0]
    return np.stack([face, locks, np.maximum(1 - face - locks, 0)], axis=2)


def compared(
    head: str,
    name: str,
    matting: Matting,
    photo: Image,
    landmarks: Landmarks,
    labels: Segmentation,
    truth: FloatArray,
    labels_ms: float,
) -> Segmented:
    matting(photo, labels, landmarks)
    result, elapsed, peak = _measured(lambda: matting(photo, labels, landmarks))
    found = np.stack([result.face, result.hair, result.background], axis=2)
    shown, right = found.argmax(axis=2), truth.argmax(axis=2)
    pairs = [(shown == k, right == k) for k in range(3)]
    return Segmented(
        head=head,
        matting=name,
        iou=tuple(iou(a, b) for a, b in pairs),
        boundary=tuple(boundary_error(a, b) for a, b in pairs),
        softness=tuple(float(v) for v in np.abs(found - truth).mean(axis=(0, 1))),
        labels_ms=labels_ms,
        matting_ms=elapsed,
        peak_mb=peak,
    )


def iou(found: NDArray[np.bool_], truth: NDArray[np.bool_]) -> float:
    """Intersection over union; 1 where both are empty."""
    union = int((found | truth).sum())
    return int((found & truth).sum()) / union if union else 1.0


def boundary_error(found: NDArray[np.bool_], truth: NDArray[np.bool_]) -> float:
    """Mean distance from each outline to the other, pixels; the picture's size where one of them is missing."""
    outlines = [_outline(found), _outline(truth)]
    if not any(o.any() for o in outlines):
        return 0.0
    if not all(o.any() for o in outlines):
        return float(max(found.shape))
    import cv2

    away = [cv2.distanceTransform((~o).astype(np.uint8), cv2.DIST_L2, 5) for o in outlines]
    return float((away[1][outlines[0]].mean() + away[0][outlines[1]].mean()) / 2)


def _outline(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pixels of a mask with a neighbour outside of it."""
    import cv2

    shrunk = cv2.erode(mask.astype(np.uint8), np.ones((3, 3), np.uint8), borderType=cv2.BORDER_REPLICATE)
    return np.asarray(mask & (shrunk == 0))


def _measured(work: Callable[[], Segmentation]) -> tuple[Segmentation, float, float]:
    """The result, milliseconds of one run, and peak megabytes of another, since tracing memory takes time."""
    start = time.perf_counter()
    result = work()
    elapsed = (time.perf_counter() - start) * 1000
    tracemalloc.start()
    work()
    peak = tracemalloc.get_traced_memory()[1] / 2**20
    tracemalloc.stop()
    return result, elapsed, peak
