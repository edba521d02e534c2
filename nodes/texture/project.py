"""A texture drawn onto the face in a photo."""

from __future__ import annotations

from graphface import node
from graphface.nodes.face_coordinates import face_coordinates
from graphface.nodes.texture.texels import sampled, texels
from graphface.nodes.types import Image, Mesh, Surface, Texture


@node("texture.project")
def project(texture: Texture, photo: Image, mesh: Mesh, surface: Surface) -> Image:
    """The photo with the texture on its face, weighted by how well each texel was seen.

    Args:
        mesh, surface: the photo's, with the texture coordinates that the texture was unwrapped by.

    Raises:
        UsageError: the mesh has no texture coordinates.
    """
    size = texture.image.width
    at = texels(face_coordinates(surface, mesh), size)
    colors, seen = sampled(texture.image.pixels, at), sampled(texture.seen, at)
    cover = (seen * (surface.coverage > 0))[..., None]
    return photo.with_pixels(photo.pixels * (1 - cover) + colors * cover)
