"""No flow: the correspondence of the meshes alone."""

from __future__ import annotations

from graphface import node
from graphface.nodes.types import Correspondence, Image, Landmarks


@node("flow.none")
def none(photo: Image, reference: Image, correspondence: Correspondence, landmarks: Landmarks) -> Correspondence:
    """The correspondence as it is."""
    return correspondence
