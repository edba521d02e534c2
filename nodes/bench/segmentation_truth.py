"""Segment the path-traced heads, whose labels are known: how far off each choice of matting is, and what it costs.

The truth calls the painted inside of the ears hair; nothing in a photo says so, and it is counted as it stands.
"""

from __future__ import annotations

import tracemalloc
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import Graph
from graphface.nodes.bench.heads import LABELS, LIGHTS, Head, heads_of
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.bench.segmentation_graphs import MATTED, MATTINGS, segmentation_graph, unmatted
from graphface.nodes.masks.label_weights import LabelWeights
from graphface.nodes.metrics import iou
from graphface.nodes.types import Segmentation


@dataclass(frozen=True)
class Segmented:
    """One head with one choice of matting; figures are by label, in the order of `LABELS`.

    `iou`: intersection over union of the likeliest labels. `boundary`: mean distance between found and true outline,
    both ways, in pixels. CPU milliseconds: `labels_ms` from the mesh to the labels before matting, `matting_ms` from
    there on. `peak_mb`: most memory that arrays took during matting.
    """

    head: str
    matting: str
    iou: tuple[float, ...]
    boundary: tuple[float, ...]
    labels_ms: float
    matting_ms: float
    peak_mb: float


def segment_truth(
    data: Path,
    mattings: Sequence[str] = MATTINGS,
    *,
    labels: str = "classify",
    light: str = LIGHTS[0],
    weights: LabelWeights | None = None,
) -> Iterator[Segmented]:
    """Segment every head of `data`/truth with every choice of matting.

    Args:
        mattings: of `MATTINGS`. labels: one of `LABELLINGS`. light: of the photo.
        weights: of the cue's network, the shipped ones by default.

    Raises:
        UnreadableFile: there are no heads at `data`.
    """
    heads = heads_of(data)
    graphs = {matting: segmentation_graph(labels, matting) for matting in mattings}
    for head in heads:
        yield from _segmented(head, graphs, unmatted(labels), light, weights)


def _segmented(
    head: Head, graphs: Mapping[str, Graph], labels: str, light: str, weights: LabelWeights | None
) -> Iterator[Segmented]:
    evaluator = MeteredEvaluator()
    inputs: dict[str, Any] = {"photo": head.path(light), "segment/label_weights": weights}
    truth = head.labels.argmax(axis=2)
    for matting, graph in graphs.items():
        graph.run([labels, MATTED], evaluator=evaluator, **inputs)
        evaluator.forget(evaluator.key(MATTED))  # run again: what a method imports is not what is measured
        found = likeliest(graph.run([MATTED], evaluator=evaluator, **inputs)[MATTED])
        surface, before, matted = (evaluator.key(node) for node in ("surface", labels, MATTED))
        labels_ms, matting_ms = evaluator.cpu_ms(before, [surface]), evaluator.cpu_ms(matted, [before])
        evaluator.forget(matted)
        yield Segmented(
            head=head.name,
            matting=matting,
            iou=overlaps(found, truth),
            boundary=tuple(boundary_error(found == k, truth == k) for k in range(len(LABELS))),
            labels_ms=labels_ms,
            matting_ms=matting_ms,
            peak_mb=_peak(graph, evaluator, inputs),
        )


def likeliest(labels: Segmentation) -> NDArray[np.intp]:
    """The label of every pixel, H x W: 0 face, 1 hair, 2 background."""
    return np.asarray(np.stack([labels.face, labels.hair, labels.background]).argmax(axis=0))


def overlaps(found: NDArray[np.intp], truth: NDArray[np.intp]) -> tuple[float, ...]:
    """Intersection over union of each label of two maps as `likeliest` gives them; 1 where neither has a label."""
    return tuple(iou((found == k).astype(np.float32), (truth == k).astype(np.float32)) for k in range(len(LABELS)))


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


def _peak(graph: Graph, evaluator: MeteredEvaluator, inputs: Mapping[str, Any]) -> float:
    """Peak megabytes of the matting alone, which runs once more: tracing memory takes time."""
    tracemalloc.start()
    graph.run([MATTED], evaluator=evaluator, **inputs)
    peak = tracemalloc.get_traced_memory()[1] / 2**20
    tracemalloc.stop()
    return peak
