"""Hair that the user gives, in place of detected hair."""

from __future__ import annotations

from graphface import Lazy, Needs, node
from graphface.nodes.masks.given_mask import checked_masks, unless_all_given
from graphface.nodes.masks.hair import Hair
from graphface.nodes.types import Mask


def _needs(given: Mask | None) -> Needs:
    return unless_all_given(given=given)


@node("masks.given_hair", needs=_needs)
def given_hair(computed: Lazy[Hair], given: Mask | None = None) -> Hair:
    """What is hair for certain: the given mask where there is one, else the computed hair.

    Raises:
        UsageError: hair is neither given nor computed.
    """
    if given is None and computed is not None:
        return computed
    mask = checked_masks("masks.given_hair", {"hair": given}, None)["hair"]
    return Hair(mask, mask)
