"""Arrays whose meaning is their type: masks, normals, depth, albedo, shading, detail; all float32."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray

from graphface import ArrayType

FloatArray = NDArray[np.float32]


Encoding = Literal["srgb", "linear"]


Mask = Annotated[
    FloatArray,
    ArrayType("Mask", "H W", doc="Coverage, 0 outside to 1 inside.", low=0, high=1, dtype="float32", bounded=True),
]


Normals = Annotated[
    FloatArray,
    ArrayType(
        "Normals",
        "H W 3",
        doc="Unit normals in the camera frame; (0, 0, 0): no surface.",
        low=-1,
        high=1,
        dtype="float32",
        bounded=True,
    ),
]


Depth = Annotated[
    FloatArray,
    ArrayType(
        "Depth",
        "H W",
        doc="z in the camera frame, pixels, larger is nearer; 0 where there is no surface.",
        dtype="float32",
    ),
]


Albedo = Annotated[
    FloatArray, ArrayType("Albedo", "H W 3", doc="Reflectance: color over shading.", low=0, dtype="float32")
]


Shading = Annotated[
    FloatArray, ArrayType("Shading", "...", doc="Irradiance, H x W or H x W x 3.", low=0, dtype="float32")
]


Detail = Annotated[FloatArray, ArrayType("Detail", "H W 3", doc="Photo minus rendering, signed.", dtype="float32")]


Direction = Annotated[
    FloatArray, ArrayType("Direction", "3", doc="Unit vector in the camera frame; (0, 0, 0): none.", dtype="float32")
]


Gain = Annotated[
    FloatArray,
    ArrayType("Gain", "H W 3", doc="Photo over rendering, a factor.", low=0, dtype="float32"),
]


FaceCoordinates = Annotated[
    FloatArray,
    ArrayType(
        "FaceCoordinates",
        "H W 2",
        low=-1,
        high=1,
        dtype="float32",
        bounded=True,
        doc="Point on the face (u, v), 0..1, v up; -1 off it.",
    ),
]


Visibility = Annotated[
    FloatArray,
    ArrayType(
        "Visibility",
        "V",
        low=0,
        high=1,
        dtype="float32",
        bounded=True,
        doc="How far the camera sees each vertex, 0..1.",
    ),
]
