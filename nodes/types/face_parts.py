"""Soft masks that say which part of a face or of a head each pixel shows."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types.arrays import Mask
from graphface.nodes.types.pictures import as_bytes


@dataclass(frozen=True)
class Features:
    """Masks H x W: openings `eyes` and `mouth`; `lips` without the mouth, and the skin `around` them with the corners
    of the mouth; `lids`, `brows`, `nose`, `cheeks`."""

    eyes: Mask
    mouth: Mask
    lips: Mask
    around: Mask
    lids: Mask
    brows: Mask
    nose: Mask
    cheeks: Mask

    @property
    def openings(self) -> Mask:
        """Eyes and mouth: what lies in them is not skin."""
        return self.any_of("eyes", "mouth")

    def any_of(self, *names: str) -> Mask:
        """The largest of some of the masks."""
        first, *others = (getattr(self, name) for name in names)
        largest: Mask = first.copy()
        for mask in others:
            np.maximum(largest, mask, out=largest)
        return largest

    @staticmethod
    def picture(features: Features) -> NDArray[np.uint8]:
        """Red lips and cheeks, green lids and nose, blue brows; the openings white."""
        openings = features.any_of("eyes", "mouth")
        red = np.maximum(features.lips, 0.5 * features.cheeks)
        green = np.maximum(features.lids, 0.5 * features.nose)
        colors = np.stack([np.maximum(c, openings) for c in (red, green, features.brows)], axis=2)
        return np.asarray(np.rint(np.clip(colors, 0, 1) * 255), np.uint8)


@dataclass(frozen=True)
class HeadMasks:
    """What the projected geometry alone says (paper, section 2, "Face segmentation"); each is 0 or 1, H x W.

    `conservative` is surely face, `normal` about face and head with ears, `aggressive` all that may be face.
    """

    conservative: Mask
    normal: Mask
    aggressive: Mask


@dataclass(frozen=True)
class Segmentation:
    """How much of each pixel is face (with ears and neck), hair, and background: H x W each, summing to 1."""

    face: Mask
    hair: Mask
    background: Mask

    @staticmethod
    def picture(segmentation: Segmentation) -> NDArray[np.uint8]:
        """Red is hair, green is face."""
        parts = [segmentation.hair, segmentation.face, np.zeros_like(segmentation.face)]
        return as_bytes(np.stack(parts, axis=2))


@dataclass(frozen=True)
class Regions:
    """Nine soft masks, H x W each; they sum to at most 1."""

    left_brow: Mask
    right_brow: Mask
    left_eye: Mask
    right_eye: Mask
    forehead: Mask
    nose: Mask
    mouth: Mask
    left_cheek: Mask
    right_cheek: Mask


REGIONS = tuple(field.name for field in fields(Regions))
"""The names of the nine regions."""
