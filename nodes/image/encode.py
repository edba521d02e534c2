"""Pictures in sRGB or in linear light."""

from __future__ import annotations

from graphface import node
from graphface.nodes.color import decode_srgb, encode_srgb
from graphface.nodes.types import Encoding, Image


@node("image.encode")
def encode(photo: Image, *, encoding: Encoding) -> Image:
    """The same picture with its values sRGB-encoded or in linear light; the same object if it already has them so."""
    if photo.encoding == encoding:
        return photo
    convert = encode_srgb if encoding == "srgb" else decode_srgb
    return photo.with_pixels(convert(photo.pixels), encoding)
