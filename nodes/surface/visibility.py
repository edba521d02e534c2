"""Visibility of the vertices of a mesh."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from graphface import node
from graphface.nodes.types import Mesh, Surface, Visibility
from graphface.nodes.vertex_visibility import vertex_visibility


@node("surface.visibility")
def visibility(
    surface: Surface,
    mesh: Mesh,
    *,
    facing: Annotated[float, Field(gt=0, lt=1)] = 0.2,
    depth_tolerance: Annotated[float, Field(gt=0, le=1)] = 0.05,
) -> Visibility:
    """How visible each vertex is: inside the frame, facing the camera, not occluded.

    Args:
        surface: of the same mesh.
        facing: cosine between normal and view direction from which a vertex is fully visible; at 0 it is hidden.
        depth_tolerance: depth behind the drawn surface up to which a vertex is visible, in inter-ocular distances; at
            twice that it is hidden.

    Returns:
        float32 (V,), from 0 (hidden) to 1 (visible).
    """
    return vertex_visibility(surface, mesh, facing=facing, depth_tolerance=depth_tolerance)
