"""Head masks that the user gives, in place of those of the projected geometry."""

from __future__ import annotations

from graphface import Lazy, Needs, node
from graphface.nodes.masks.given_mask import checked_masks, unless_all_given
from graphface.nodes.types import HeadMasks, Mask


def _needs(conservative: Mask | None, normal: Mask | None, aggressive: Mask | None) -> Needs:
    return unless_all_given(conservative=conservative, normal=normal, aggressive=aggressive)


@node("masks.given_head", needs=_needs)
def given_head(
    computed: Lazy[HeadMasks],
    conservative: Mask | None = None,
    normal: Mask | None = None,
    aggressive: Mask | None = None,
) -> HeadMasks:
    """Conservative, normal and aggressive mask: the given ones where there are any, else the computed ones.

    Raises:
        UsageError: a given mask is not of the photo's size, or a mask is neither given nor computed.
    """
    given = {"conservative": conservative, "normal": normal, "aggressive": aggressive}
    masks = checked_masks("masks.given_head", given, computed.normal.shape if computed is not None else None)
    return HeadMasks(**{name: masks[name] if name in masks else getattr(computed, name) for name in given})
