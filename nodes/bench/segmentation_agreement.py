"""How far labels agree with those of `masks.network` on photos, whose true labels nobody knows.

The network is not the truth, but on portraits its labels are right nearly everywhere to the eye, and it knows nothing
of this project: where labels disagree with it, they are worth a look.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from graphface.nodes.bench.segmentation_noise import LEAST, likeliest, portraits
from graphface.nodes.bench.segmentation_truth import Labeller, iou, segment_by_network, segment_photo


@dataclass(frozen=True)
class Agreed:
    """Overlap of each label with the network's, None where the network sees less than `LEAST` of the picture as it."""

    photo: str
    overlaps: tuple[float | None, ...]

    @property
    def worst(self) -> float:
        return min((overlap for overlap in self.overlaps if overlap is not None), default=1.0)


def segment_agreement(photos: Iterable[Path], label: Labeller = segment_photo) -> Iterator[Agreed]:
    """Label every photo both ways, each after guided matting."""
    for name, photo, landmarks in portraits(photos):
        found, other = likeliest(photo, landmarks, label), likeliest(photo, landmarks, segment_by_network)
        pairs = [(found == k, other == k) for k in range(3)]
        yield Agreed(name, tuple(iou(a, b) if b.mean() >= LEAST else None for a, b in pairs))
