"""Which vertices the camera sees."""

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
    """How far the camera sees each vertex: inside the frame, turned towards the viewer, nothing in front of it.

    Args:
        surface: of the same mesh.
        facing: cosine between normal and view from which a vertex is fully seen; turned away, it is not.
        depth_tolerance: how far behind the drawn surface a vertex may lie, in eye distances; at twice it is hidden.

    Returns:
        float32 (V,), 0 hidden to 1 seen.
    """
    return vertex_visibility(surface, mesh, facing=facing, depth_tolerance=depth_tolerance)
