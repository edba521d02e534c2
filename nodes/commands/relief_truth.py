"""The relief of the built-in model, learned from path-traced heads whose normals are known.

`graphface models relief learned.safetensors --data DATA` made the built-in model of the one that `graphface models
learn` had written. Six heads are few, so the figures that count are those of heads that took no part, and of other
faces altogether.
"""

from __future__ import annotations

from pathlib import Path
from statistics import fmean

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.commands.heads import heads_of
from graphface.nodes.geometry.morphable import morphable
from graphface.nodes.io.image_read import read_image
from graphface.nodes.landmarks.facemesh import facemesh
from graphface.nodes.metrics import normal_angle
from graphface.nodes.morphable.model import MorphableModel
from graphface.nodes.morphable.relief import Difference, learned_relief, normal_difference, with_relief
from graphface.nodes.morphable.storage import refined
from graphface.nodes.surface.rasterize import rasterize
from graphface.nodes.types import Image, Landmarks

_LEVELS = 1


def relief_of_heads(coarse: MorphableModel, data: Path) -> tuple[MorphableModel, dict[str, float]]:
    """The model with the relief of the heads of `data`/truth.

    Returns:
        The coarse model, and the mean angle between its normals and the true ones, degrees: "before", "after", and
        "unseen" for each head by the relief of the others.

    Raises:
        UnreadableFile: there are no heads at `data`.
    """
    heads = [_Head(folder) for folder in heads_of(data)]
    plain = refined(coarse, _LEVELS)
    faces = [head.difference(plain) for head in heads]
    better = _with_relief_of(coarse, faces)
    off = {
        "before": fmean(head.degrees_off(plain) for head in heads),
        "after": fmean(head.degrees_off(refined(better, _LEVELS)) for head in heads),
    }
    if len(heads) > 1:
        others = [_with_relief_of(coarse, faces[:k] + faces[k + 1 :]) for k in range(len(heads))]
        unseen = [head.degrees_off(refined(m, _LEVELS)) for head, m in zip(heads, others, strict=True)]
        off["unseen"] = fmean(unseen)
    return better, off


def _with_relief_of(coarse: MorphableModel, faces: list[Difference]) -> MorphableModel:
    return with_relief(coarse, learned_relief(coarse, _LEVELS, faces))


class _Head:
    photo: Image
    landmarks: Landmarks
    normals: NDArray[np.float32]
    mask: NDArray[np.float32]

    def __init__(self, folder: Path) -> None:
        self.photo = read_image(folder / "frontal.png")
        self.landmarks = facemesh(self.photo)
        self.mask = (read_image(folder / "labels.png").pixels[..., 1] > 0.5).astype(np.float32)
        with np.load(folder / "aov.npz") as maps:
            self.normals = maps["normal"].astype(np.float32)

    def difference(self, model: MorphableModel) -> Difference:
        mesh = morphable(self.landmarks, model=model)
        return normal_difference(mesh, rasterize(mesh, self.photo), self.normals, self.mask)

    def degrees_off(self, model: MorphableModel) -> float:
        surface = rasterize(morphable(self.landmarks, model=model), self.photo)
        return float(normal_angle(surface.normals, self.normals, self.mask))
