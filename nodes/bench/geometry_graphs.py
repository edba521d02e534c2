"""The shipped representation with a face model, or points that are known, as further inputs of the graph."""

from __future__ import annotations

from typing import Any

from graphface import Graph, load


def geometry_graph(operator: str) -> Graph:
    """represent.yaml with another geometry that needs no model, "geometry.facemesh" for one."""
    return load("represent", replace={"mesh": operator})


def model_graph(operator: str = "geometry.morphable") -> Graph:
    """represent.yaml with the input `model`, which `operator` fits to the photo's landmarks."""
    return load(_extended({"model": "model"}, model="MorphableModel | None"), replace={"mesh": operator})


def points_graph(*, slide: bool) -> Graph:
    """represent.yaml with the inputs `points`, in the place of those found in a photo, and `model`.

    Args:
        slide: the points of the jaw lie on the outline that is seen; False: they lie on the face, hidden or not.
    """
    ports = {"landmarks": "points", "model": "model"}
    return load(_extended(ports, points="Landmarks", model="MorphableModel | None"), set={"mesh.slide": slide})


def _extended(ports: dict[str, str], **inputs: str) -> dict[str, Any]:
    """A graph document: represent.yaml with further inputs, plugged into ports of its mesh."""
    return {"graphface": 1, "extends": "represent.yaml", "inputs": inputs, "nodes": {"mesh": {"in": ports}}}
