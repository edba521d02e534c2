"""Segment photos with and without noise of one 8-bit level: how far the labels jump."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from graphface import Evaluator, Graph, GraphfaceError, load, warn
from graphface.nodes.bench.heads import LABELS
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.bench.segmentation_graphs import segmentation_graph
from graphface.nodes.bench.segmentation_truth import likeliest, overlaps
from graphface.nodes.io.image_read import read_image
from graphface.nodes.masks.label_weights import LabelWeights
from graphface.nodes.types import Image, Landmarks

LEAST = 0.005
"""Share of the picture below which a label is not judged: a few pixels of background beside a face that fills it."""


@dataclass(frozen=True)
class Portrait:
    """A photo, its name and the landmarks of its face."""

    name: str
    photo: Image
    landmarks: Landmarks


@dataclass(frozen=True)
class UnderNoise:
    """Overlap of each label with itself under noise, the worst of all seeds, in the order face, hair, background.

    `shares`: how much of the picture each label covers. `worst`: the least overlap of a label of at least `LEAST`.
    `milliseconds` of CPU for the labels of the photo, landmarks given.
    """

    photo: str
    overlaps: tuple[float, ...]
    shares: tuple[float, ...]
    milliseconds: float = 0.0

    @property
    def worst(self) -> float:
        return min((o for o, s in zip(self.overlaps, self.shares, strict=True) if s >= LEAST), default=1.0)


def segment_noise(
    photos: Iterable[Path], seeds: int = 2, *, labels: str = "classify", weights: LabelWeights | None = None
) -> Iterator[UnderNoise]:
    """Segment every photo as it is and with noise; `labels` is one of `LABELLINGS`, `weights` are those of the cue.

    The landmarks are those of the photo without noise: how steady they are is another stage's promise.
    """
    graph = segmentation_graph(labels, points=True)
    for portrait in portraits(photos):
        yield under_noise(portrait, graph, seeds, weights)


def portraits(photos: Iterable[Path]) -> Iterator[Portrait]:
    """The files that show a face; what is no picture, or shows none, is warned about and left out."""
    graph = load("represent")
    for path in photos:
        try:
            photo = read_image(path)
            found = graph.run(["landmarks"], evaluator=Evaluator(), photo=photo)
        except GraphfaceError as error:
            warn(f"{path.name} is left out: {error}")
            continue
        yield Portrait(path.stem, photo, found["landmarks"])


def under_noise(portrait: Portrait, graph: Graph, seeds: int = 2, weights: LabelWeights | None = None) -> UnderNoise:
    """One photo through a graph with the input `points`; noise adds -1, 0 or 1 level of 255 to every value."""
    evaluator = MeteredEvaluator()
    pixels = portrait.photo.pixels
    given = {"points": portrait.landmarks, "segment/label_weights": weights}
    before = likeliest(graph.run(["labels"], evaluator=evaluator, photo=portrait.photo, **given)["labels"])
    spent = evaluator.cpu_ms(evaluator.key("labels"))
    kept = (1.0,) * len(LABELS)
    for seed in range(seeds):
        noise = np.random.default_rng(seed).integers(-1, 2, pixels.shape) / 255
        noisy = portrait.photo.with_pixels(np.clip(pixels + noise, 0, 1))
        after = likeliest(graph.run(["labels"], evaluator=evaluator, photo=noisy, **given)["labels"])
        kept = tuple(map(min, kept, overlaps(before, after)))
    return UnderNoise(portrait.name, kept, tuple(float((before == k).mean()) for k in range(len(LABELS))), spent)
