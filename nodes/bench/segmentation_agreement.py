"""How far labels agree with those of `masks.network` on photos, whose true labels nobody knows.

The network is not the truth, but on portraits its labels are right nearly everywhere to the eye, and it knows nothing
of this project: where labels disagree with it, they are worth a look.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from graphface import GraphfaceError, warn
from graphface.nodes.bench.heads import LABELS
from graphface.nodes.bench.metered import MeteredEvaluator
from graphface.nodes.bench.segmentation_graphs import segmentation_graph
from graphface.nodes.bench.segmentation_noise import LEAST
from graphface.nodes.bench.segmentation_truth import likeliest, overlaps
from graphface.nodes.masks.label_weights import LabelWeights


@dataclass(frozen=True)
class Agreed:
    """Overlap of each label with the network's, None where the network sees less than `LEAST` of the picture as it.

    CPU `milliseconds` of the labels and of the network's, landmarks and mesh given.
    """

    photo: str
    overlaps: tuple[float | None, ...]
    milliseconds: float = 0.0
    network_ms: float = 0.0

    @property
    def worst(self) -> float:
        return min((overlap for overlap in self.overlaps if overlap is not None), default=1.0)


def segment_agreement(
    photos: Iterable[Path], *, labels: str = "classify", weights: LabelWeights | None = None
) -> Iterator[Agreed]:
    """Label every photo both ways; what is no picture, or shows no face, is warned about and left out.

    Args:
        labels: one of `LABELLINGS`. weights: of the cue's network, the shipped ones by default.
    """
    graph, network = segmentation_graph(labels), segmentation_graph("network")
    asked = ("surface", "labels")
    for path in photos:
        evaluator = MeteredEvaluator()
        try:
            own = graph.run(asked, evaluator=evaluator, photo=path, **{"segment/label_weights": weights})
        except GraphfaceError as error:
            warn(f"{path.name} is left out: {error}")
            continue
        surface, found = (evaluator.key(node) for node in asked)
        other = network.run(asked, evaluator=evaluator, photo=path)
        yield Agreed(
            photo=path.stem,
            overlaps=agreement(likeliest(own["labels"]), likeliest(other["labels"])),
            milliseconds=evaluator.cpu_ms(found, [surface]),
            network_ms=evaluator.cpu_ms(evaluator.key("labels"), [surface]),
        )


def agreement(found: NDArray[np.intp], network: NDArray[np.intp]) -> tuple[float | None, ...]:
    """Overlap of each label (0 face, 1 hair, 2 background), None where the network has too little of it."""
    shares = [float((network == k).mean()) for k in range(len(LABELS))]
    return tuple(o if share >= LEAST else None for o, share in zip(overlaps(found, network), shares, strict=True))
