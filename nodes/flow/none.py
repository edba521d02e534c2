"""No flow: the meshes alone."""

from __future__ import annotations

from graphface import node
from graphface.nodes.types import Image, Landmarks
from graphface.nodes.warp.correspondence import Correspondence


@node("flow.none")
def none(photo: Image, reference: Image, correspondence: Correspondence, landmarks: Landmarks) -> Correspondence:
    """The correspondence as it comes."""
    return correspondence
