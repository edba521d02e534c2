"""No scattering."""

from __future__ import annotations

from graphface import node
from graphface.nodes.types import Image, Landmarks, Scene, Shading, Surface


@node("scatter.none")
def none(
    shading: Shading, estimated: Shading, surface: Surface, landmarks: Landmarks, photo: Image, scene: Scene
) -> Shading:
    """The shading as it is, for comparison."""
    return shading
