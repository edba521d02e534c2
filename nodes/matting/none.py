"""No matting: the soft labels of the classifiers."""

from __future__ import annotations

from graphface import node
from graphface.nodes.types import Image, Landmarks, Segmentation


@node("matting.none")
def none(photo: Image, labels: Segmentation, landmarks: Landmarks) -> Segmentation:
    """The labels, unchanged."""
    return labels
