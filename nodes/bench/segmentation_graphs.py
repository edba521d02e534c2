"""The shipped representation with its labels found and matted in other ways."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphface import Graph, load

MATTINGS = ("none", "guided", "closed_form", "knn")

LABELLINGS = ("classify", "cue", "detector", "mixtures", "network")
"""What finds the labels: the classifiers as shipped, the cue that they start from, or a variant of segment.yaml."""

MATTED = "segment/matted"
"""The node of the labels after matting."""


def unmatted(labels: str = "classify") -> str:
    """The node of the labels before matting, for one of `LABELLINGS`."""
    return "segment/cue" if labels == "cue" else "segment/classes"


def segmentation_graph(
    labels: str = "classify",
    matting: str = "guided",
    *,
    points: bool = False,
    settings: Mapping[str, Any] | None = None,
) -> Graph:
    """represent.yaml with one of `LABELLINGS` and one of `MATTINGS`.

    Args:
        points: the landmarks are the input `points`, not found in the photo.
        settings: parameters of the matting.
    """
    document: dict[str, Any] = {"graphface": 1, "extends": "represent.yaml"}
    if points:
        document["inputs"] = {"points": "Landmarks"}
        document["nodes"] = {"detected": {"use": "landmarks.given", "in": {"photo": "photo", "points": "points"}}}
    if labels == "cue":
        document["variants"] = {"cue": {MATTED: {"in": {"labels": "cue"}}}}
    variants = [] if labels == "classify" else [labels]
    set_ = {f"{MATTED}.{name}": value for name, value in (settings or {}).items()}
    return load(document, variants=variants, replace={MATTED: f"matting.{matting}"}, set=set_)
