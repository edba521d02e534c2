"""Soft masks of the parts of a face and of a head."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from graphface.nodes.types.agreement import mismatch
from graphface.nodes.types.arrays import Mask


@dataclass(frozen=True)
class Features:
    """Parts of the face, float32 H x W each, 0..1.

    Attributes:
        eyes, mouth: the openings.
        lips: without the opening of the mouth. around: the skin around the lips, with the corners of the mouth.
        lids, brows, nose, cheeks: of both sides.
    """

    eyes: Mask
    mouth: Mask
    lips: Mask
    around: Mask
    lids: Mask
    brows: Mask
    nose: Mask
    cheeks: Mask

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        return mismatch(self, dict.fromkeys((field.name for field in fields(self)), "H W"))

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


@dataclass(frozen=True)
class HeadMasks:
    """Masks of the projected geometry (paper, section 3, "Face segmentation"), float32 H x W each, 0 or 1.

    Attributes:
        conservative: certainly face.
        normal: approximately face and head with ears.
        aggressive: an expansion of `normal`.
    """

    conservative: Mask
    normal: Mask
    aggressive: Mask

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        return mismatch(self, dict.fromkeys((field.name for field in fields(self)), "H W"))


@dataclass(frozen=True)
class Segmentation:
    """The shares of face (with ears and neck), hair and background at each pixel, float32 H x W each; they sum to 1."""

    face: Mask
    hair: Mask
    background: Mask

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        return mismatch(self, dict.fromkeys((field.name for field in fields(self)), "H W"))


@dataclass(frozen=True)
class Regions:
    """The nine regions of detail transfer (paper, section 4.3), float32 H x W each, 0..1; they sum to at most 1.

    Left and right are the person's own.
    """

    left_brow: Mask
    right_brow: Mask
    left_eye: Mask
    right_eye: Mask
    forehead: Mask
    nose: Mask
    mouth: Mask
    left_cheek: Mask
    right_cheek: Mask

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        return mismatch(self, dict.fromkeys((field.name for field in fields(self)), "H W"))


REGIONS = tuple(field.name for field in fields(Regions))
"""The names of the nine regions."""
