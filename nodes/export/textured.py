"""A mesh and its texture as one model."""

from __future__ import annotations

from graphface import node
from graphface.nodes.face_coordinates import mesh_uv
from graphface.nodes.types import Mesh, Texture, TexturedMesh


@node("export.textured")
def textured(mesh: Mesh, texture: Texture) -> TexturedMesh:
    """Mesh and texture together, to be written as one model.

    Raises:
        UsageError: the mesh has no texture coordinates.
    """
    mesh_uv(mesh)
    return TexturedMesh(mesh, texture)
