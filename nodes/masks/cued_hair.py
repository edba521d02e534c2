"""Hair by labels found elsewhere."""

from __future__ import annotations

from graphface import node
from graphface.nodes.masks.hair import Hair
from graphface.nodes.types import HeadMasks, Segmentation


@node("masks.cued_hair")
def cued_hair(labels: Segmentation, masks: HeadMasks) -> Hair:
    """What is hair by labels found elsewhere, in place of the detector `masks.hair`."""
    return Hair(labels.hair, labels.hair * masks.normal)
