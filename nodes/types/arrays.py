"""Arrays whose meaning is their type: masks, normals, depth, albedo, shading, detail; all float32."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray

from graphface import ArrayType
from graphface.nodes.types.pictures import (
    picture_albedo,
    picture_depth,
    picture_gain,
    picture_normals,
    picture_signed,
    picture_unit,
)

FloatArray = NDArray[np.float32]


Encoding = Literal["srgb", "linear"]


PICTURES = (".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff")
"""Suffixes of picture files."""


def _write_picture(pixels: Any, path: Path, text: Mapping[str, str] | None) -> None:
    from graphface.nodes.io.image_write import write_picture

    write_picture(pixels, path, text=text)


def _mask_from_file(path: Path) -> FloatArray:
    from graphface.nodes.color import channel_mean
    from graphface.nodes.io.image_read import read_image

    return channel_mean(read_image(path).pixels)


def _map(name: str, shape: str, doc: str, picture: Any, **more: Any) -> ArrayType:
    def to_file(value: Any, path: Path, text: Mapping[str, str] | None = None) -> None:
        _write_picture(picture(value), path, text)

    return ArrayType(name, shape, doc=doc, picture=picture, to_file=to_file, suffixes=PICTURES, **more)


Mask = Annotated[
    FloatArray,
    _map("Mask", "H W", "Coverage, 0 outside to 1 inside.", picture_unit, low=0, high=1, from_file=_mask_from_file),
]


Normals = Annotated[
    FloatArray,
    _map(
        "Normals", "H W 3", "Unit normals in the camera frame; (0, 0, 0): no surface.", picture_normals, low=-1, high=1
    ),
]


Depth = Annotated[
    FloatArray,
    _map(
        "Depth", "H W", "z in the camera frame, pixels, larger is nearer; 0 where there is no surface.", picture_depth
    ),
]


Albedo = Annotated[FloatArray, _map("Albedo", "H W 3", "Reflectance: color over shading.", picture_albedo, low=0)]


Shading = Annotated[FloatArray, _map("Shading", "...", "Irradiance, H x W or H x W x 3.", picture_unit, low=0)]


Detail = Annotated[FloatArray, _map("Detail", "H W 3", "Photo minus rendering, signed.", picture_signed)]


Direction = Annotated[FloatArray, ArrayType("Direction", "3", doc="Unit vector in the camera frame; (0, 0, 0): none.")]


Gain = Annotated[FloatArray, _map("Gain", "H W 3", "Photo over rendering, a factor.", picture_gain, low=0)]


FaceCoordinates = Annotated[
    FloatArray,
    ArrayType("FaceCoordinates", "H W 2", low=-1, high=1, doc="Point on the face (u, v), 0..1, v up; -1 off it."),
]


Visibility = Annotated[
    FloatArray, ArrayType("Visibility", "V", low=0, high=1, doc="How far the camera sees each vertex, 0..1.")
]
