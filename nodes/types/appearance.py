"""What a face looks like: albedo and shading of a picture, detail maps, textures."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from graphface.nodes.types.agreement import mismatch
from graphface.nodes.types.arrays import Albedo, Detail, FloatArray, Gain, Mask, Shading
from graphface.nodes.types.geometry import Mesh
from graphface.nodes.types.image import Image


@dataclass(frozen=True)
class Intrinsic:
    """A picture split into albedo and shading; their product is the picture.

    Attributes:
        albedo: float32 H x W x 3, 0 or more.
        shading: float32 H x W, above 0; both in the picture's encoding.
    """

    albedo: Albedo
    shading: Shading

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        return mismatch(self, {"albedo": "H W 3", "shading": "H W ..."})


@dataclass(frozen=True)
class DetailMap:
    """What the photo has and rendering lacks: photo = gain * rendering + offset.

    One form for all methods: the paper's additive map is an offset alone, the shading ratio mainly a gain. To recombine
    (`graphface.nodes.rendering.applied`) the method need not be known.

    With a pivot the gain applies up to that rendering, and light above it is added as it is:
    photo = gain * min(rendering, pivot) + max(rendering - pivot, 0) + offset.
    Where light is added, what the photo's color differs from the rendering's fades with (pivot / rendering)^3 of the
    intensities: the color of a shadow is not that of the light which is added to it.

    With a ceiling, everything except the light above the pivot is limited to it. So a photo whose clipped highlights
    were reconstructed beyond its own values is returned as it is.

    Attributes:
        offset: float32 H x W x 3, signed, in the photo's encoding.
        gain: float32 H x W x 3, 0 or more; None stands for 1.
        pivot: float32 H x W x 3, a rendering, or None.
        ceiling: float32 H x W x 3, a picture, or None.
    """

    offset: Detail
    gain: Gain | None = None
    pivot: Albedo | None = None
    ceiling: FloatArray | None = None

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        return mismatch(self, dict.fromkeys((field.name for field in fields(self)), "H W 3"))

    def paired_with(self, other: DetailMap) -> dict[str, tuple[FloatArray, FloatArray]]:
        """The parts that this map or another one of the same size has, by name; one that is missing is 0 or a factor 1.

        >>> one, other = DetailMap(np.ones((1, 1, 3))), DetailMap(np.zeros((1, 1, 3)), gain=np.full((1, 1, 3), 2))
        >>> {name: (float(a.mean()), float(b.mean())) for name, (a, b) in one.paired_with(other).items()}
        {'offset': (1.0, 0.0), 'gain': (1.0, 2.0)}
        """
        pairs = {}
        for name in (field.name for field in fields(self)):
            own, others = getattr(self, name), getattr(other, name)
            if own is not None or others is not None:
                neutral = np.full(self.offset.shape, 0 if name == "offset" else 1, np.float32)
                pairs[name] = (neutral if own is None else own, neutral if others is None else others)
        return pairs


@dataclass(frozen=True)
class TexturedMesh:
    """A mesh and its colors."""

    mesh: Mesh
    texture: Texture


@dataclass(frozen=True)
class Texture:
    """A face's colors in the model's texture space.

    Attributes:
        image: square, row 0 at v = 1.
        seen: float32, of the same size, 0..1: how far the photo shows a texel.
    """

    image: Image
    seen: Mask

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        return mismatch(self, {"image.pixels": "S S 3", "seen": "S S"})
