"""Hair from labels that were found before."""

from __future__ import annotations

from graphface import node
from graphface.nodes.masks.hair import Hair
from graphface.nodes.types import HeadMasks, Segmentation


@node("masks.cued_hair")
def cued_hair(labels: Segmentation, masks: HeadMasks) -> Hair:
    """The hair of a segmentation, in place of the detector `masks.hair`; the mask is what lies in the normal mask."""
    return Hair(labels.hair, labels.hair * masks.normal)
