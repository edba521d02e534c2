"""A photo unwrapped onto the model's texture, and a texture put back onto a face in a photo."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, Any

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.projection.carried import carried
from graphface.nodes.projection.coordinates import coordinates, mesh_uv, visibility
from graphface.nodes.render.surface import rasterize
from graphface.nodes.types import Camera, FloatArray, Image, Mask, Mesh, Surface


@dataclass(frozen=True)
class Texture:
    """A face's colours in the model's texture space: `image`, square; `seen` how far the photo shows a texel."""

    image: Image
    seen: Mask

    @staticmethod
    def picture(texture: Texture) -> NDArray[np.uint8]:
        """The texture over grey where nothing was seen."""
        seen = texture.seen[..., None]
        return Image.picture(texture.image.with_pixels(texture.image.pixels * seen + 0.5 * (1 - seen)))

    suffixes = Image.suffixes

    @staticmethod
    def to_file(texture: Texture, path: Any) -> None:
        Image.to_file(replace(texture.image, alpha=texture.seen), path)


@node("texture.unwrap")
def unwrap(photo: Image, mesh: Mesh, surface: Surface, *, size: Annotated[int, Field(ge=8, le=8192)] = 512) -> Texture:
    """The photo's face, flattened: every texel has the colour of its point of the face in the photo.

    Args:
        surface: the mesh drawn into the photo; tells what hides what.
        size: of the texture's sides, texels.

    Raises:
        UsageError: the mesh has no texture coordinates.
    """
    chart, flat = _chart(mesh, size)
    places = carried(_pixels(mesh), chart, flat)
    shown = carried(visibility(surface, mesh)[:, None], chart, flat)[..., 0]
    inside = (
        (places >= -0.5).all(axis=2) & (places[..., 0] <= photo.width - 0.5) & (places[..., 1] <= photo.height - 0.5)
    )
    seen = shown * inside * (chart.triangle >= 0)
    if not (seen > 0).any():
        warn("texture.unwrap: the photo shows nothing of the face; the texture is empty")
    image = Image(_sampled(photo.pixels, places) * (chart.coverage[..., None] > 0), encoding=photo.encoding)
    return Texture(image, seen.astype(np.float32))


@node("texture.project")
def project(texture: Texture, photo: Image, mesh: Mesh, surface: Surface) -> Image:
    """The photo with the texture on its face, as far as the texture was seen.

    Args:
        mesh, surface: the photo's, with the texture coordinates that the texture was unwrapped by.

    Raises:
        UsageError: the mesh has no texture coordinates.
    """
    size = texture.image.width
    at = _texels(coordinates(surface, mesh), size)
    colors, seen = _sampled(texture.image.pixels, at), _sampled(texture.seen, at)
    cover = (seen * (surface.coverage > 0))[..., None]
    return photo.with_pixels(photo.pixels * (1 - cover) + colors * cover)


def _chart(mesh: Mesh, size: int) -> tuple[Surface, Mesh]:
    """The mesh laid flat into the texture, and drawn there."""
    at = _texels(mesh_uv(mesh), size)
    flat = np.column_stack([at[:, 0], -at[:, 1], np.zeros(len(at))]).astype(np.float32)
    normals = np.tile(np.array([0, 0, 1], np.float32), (len(at), 1))
    laid = replace(mesh, vertices=flat, normals=normals, camera=Camera())
    canvas = Image(np.zeros((size, size, 3), np.float32))
    return rasterize(laid, canvas, smoothing=0), laid


def _sampled(values: FloatArray, places: FloatArray) -> FloatArray:
    # With places in one map OpenCV wants None for the other, which its type stubs do not know.
    sampled = cv2.remap(values, places, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)  # type: ignore[call-overload]
    return np.asarray(sampled, np.float32)


def _texels(uv: FloatArray, size: int) -> FloatArray:
    """Texture coordinates as places among texels, y down."""
    texels: FloatArray = (np.stack([uv[..., 0], 1 - uv[..., 1]], axis=-1) * size - 0.5).astype(np.float32)
    return texels


def _pixels(mesh: Mesh) -> FloatArray:
    return np.asarray(mesh.camera.project(mesh.vertices.astype(np.float64)), np.float32)
