"""What a face looks like: a picture split into albedo and shading, detail maps, textures."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types.arrays import Albedo, Detail, FloatArray, Gain, Mask, Shading
from graphface.nodes.types.geometry import Mesh
from graphface.nodes.types.image import Image
from graphface.nodes.types.pictures import picture_gain, picture_signed


@dataclass(frozen=True)
class Intrinsic:
    """A picture split into `albedo` (H x W x 3) and `shading` (H x W): their product is the picture."""

    albedo: Albedo
    shading: Shading


@dataclass(frozen=True)
class DetailMap:
    """What the photo has and rendering lacks: photo = gain * rendering + offset.

    One form for every method: the paper's additive map is all `offset` (`gain` None stands for 1), the shading ratio is
    all `gain`. Whoever recombines (`graphface.nodes.rendering.applied`) needs not know which method it was.

    Where there is a `pivot`, the gain holds up to that rendering and light beyond it adds as it is:
    photo = gain * min(rendering, pivot) + max(rendering - pivot, 0) + offset.

    Where there is a `ceiling`, all but that light beyond the pivot stays below it: so a photo whose clipped highlights
    were reconstructed beyond what it shows is shown as it is.
    """

    offset: Detail
    gain: Gain | None = None
    pivot: Albedo | None = None
    ceiling: FloatArray | None = None

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

    @staticmethod
    def picture(detail: DetailMap) -> NDArray[np.uint8]:
        return picture_signed(detail.offset) if detail.gain is None else picture_gain(detail.gain)


@dataclass(frozen=True)
class TexturedMesh:
    """A mesh and its colors; written as .obj, .ply, .glb or .gltf."""

    mesh: Mesh
    texture: Texture


@dataclass(frozen=True)
class Texture:
    """A face's colors in the model's texture space: `image`, square; `seen` how far the photo shows a texel."""

    image: Image
    seen: Mask

    @staticmethod
    def picture(texture: Texture) -> NDArray[np.uint8]:
        """The texture over grey where nothing was seen."""
        seen = texture.seen[..., None]
        return Image.picture(texture.image.with_pixels(texture.image.pixels * seen + 0.5 * (1 - seen)))
