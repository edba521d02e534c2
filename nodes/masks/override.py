"""The user's own masks in place of computed ones: painted, or made by another program.

A given map wins everywhere; what it leaves is shared by the others as they were. The computed value is a lazy port:
where everything is given, nothing is computed.
"""

from __future__ import annotations

import numpy as np

from graphface import Lazy, Needs, UsageError, node
from graphface.nodes.masks.hair import Hair
from graphface.nodes.types import FloatArray, HeadMasks, Mask, Segmentation


def _unless_all_given(**given: object) -> Needs:
    return {"computed": "every map is given" if all(v is not None for v in given.values()) else True}


def _head_needs(conservative: Mask | None, normal: Mask | None, aggressive: Mask | None) -> Needs:
    return _unless_all_given(conservative=conservative, normal=normal, aggressive=aggressive)


@node("masks.given_head", needs=_head_needs)
def given_head(
    computed: Lazy[HeadMasks],
    conservative: Mask | None = None,
    normal: Mask | None = None,
    aggressive: Mask | None = None,
) -> HeadMasks:
    """Conservative, normal and aggressive mask, each the given one where there is one."""
    parts = {"conservative": conservative, "normal": normal, "aggressive": aggressive}
    shape = _shape(parts, computed.normal.shape if computed is not None else None)
    chosen = [
        _checked(name, part, shape) if part is not None else getattr(computed, name) for name, part in parts.items()
    ]
    return HeadMasks(*chosen)


def _hair_needs(given: Mask | None) -> Needs:
    return _unless_all_given(given=given)


@node("masks.given_hair", needs=_hair_needs)
def given_hair(computed: Lazy[Hair], given: Mask | None = None) -> Hair:
    """What is hair for certain: the given mask, or what the detector found."""
    if given is None:
        if computed is None:
            raise UsageError("masks.given_hair: neither a given mask nor a computed one is plugged in")
        return computed
    mask = _checked("hair", given, given.shape)
    return Hair(mask, mask)


def _labels_needs(face: Mask | None, hair: Mask | None, background: Mask | None) -> Needs:
    return _unless_all_given(face=face, hair=hair, background=background)


@node("masks.given_labels", needs=_labels_needs)
def given_labels(
    computed: Lazy[Segmentation],
    face: Mask | None = None,
    hair: Mask | None = None,
    background: Mask | None = None,
) -> Segmentation:
    """Labels with given ones put in their place; they still sum to 1.

    Given labels that exceed 1 together are scaled down; what they leave is shared by the computed others in their own
    proportion, and is background where those are 0.
    """
    given = {"face": face, "hair": hair, "background": background}
    if computed is not None and all(part is None for part in given.values()):
        return computed
    shape = _shape(given, computed.face.shape if computed is not None else None)
    certain = {name: _checked(name, part, shape) for name, part in given.items() if part is not None}
    total = np.asarray(sum(certain.values()), np.float32)
    certain = {name: np.asarray(part / np.maximum(total, 1), np.float32) for name, part in certain.items()}
    rest = np.maximum(1 - np.asarray(sum(certain.values()), np.float32), 0)
    others = {name: getattr(computed, name) for name in given if name not in certain}
    share = np.asarray(sum(others.values(), np.zeros(shape, np.float32)), np.float32)
    labels = certain | {name: rest * part / np.maximum(share, 1e-6) for name, part in others.items()}
    left = np.maximum(1 - np.asarray(sum(labels.values()), np.float32), 0)
    return Segmentation(labels["face"], labels["hair"], labels["background"] + left)


def _shape(parts: dict[str, FloatArray | None], shape: tuple[int, ...] | None) -> tuple[int, ...]:
    return shape if shape is not None else next(part.shape for part in parts.values() if part is not None)


def _checked(name: str, given: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    """A given mask within [0, 1].

    Raises:
        UsageError: it is not of the photo's size.
    """
    if given.shape != shape:
        raise UsageError(
            f"the given {name} mask is {given.shape[1]} x {given.shape[0]} pixels, the photo {shape[1]} x {shape[0]}; "
            "paint it over the photo itself"
        )
    return np.clip(np.nan_to_num(given, nan=0, posinf=1, neginf=0), 0, 1).astype(np.float32, copy=False)
