"""The user's own masks: painted, or made by another program. What the operators `masks.given_*` share.

The computed value is a lazy port of those operators: where every map is given, nothing is computed.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from graphface import Needs, UsageError
from graphface.nodes.types import FloatArray, Mask


def unless_all_given(**given: Mask | None) -> Needs:
    """The computed value is needed unless every map is given."""
    return {"computed": "every map is given" if all(mask is not None for mask in given.values()) else True}


def checked_masks(
    operator: str, given: Mapping[str, Mask | None], computed_shape: tuple[int, ...] | None
) -> dict[str, FloatArray]:
    """The given masks by name, within [0, 1], NaN as 0. Masks that are None are left out.

    Args:
        computed_shape: of the computed maps; None where there are none, which is right only if every mask is given.

    Raises:
        UsageError: some mask is neither given nor computed, or the masks differ in size.
    """
    missing = [name for name, mask in given.items() if mask is None]
    if computed_shape is None and missing:
        raise UsageError(
            f"{operator}: neither a given mask nor a computed one is plugged in for {', '.join(missing)}; "
            "wire the port 'computed', or give every mask"
        )
    masks = {name: mask for name, mask in given.items() if mask is not None}
    shape = computed_shape or next(iter(masks.values())).shape
    return {name: _checked(name, mask, shape) for name, mask in masks.items()}


def _checked(name: str, mask: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    if mask.shape != shape:
        raise UsageError(
            f"the given {name} mask is {mask.shape[1]} x {mask.shape[0]} pixels, the photo {shape[1]} x {shape[0]}; "
            "paint it over the photo itself"
        )
    return np.clip(np.nan_to_num(mask, nan=0, posinf=1, neginf=0), 0, 1).astype(np.float32, copy=False)
