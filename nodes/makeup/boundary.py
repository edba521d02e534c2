"""From the painted face to neck, ears and hairline (paper, "Boundary processing").

The face's boundary is shrunk, and a ring beyond it mirrored from inside. Here it is the change that is mirrored, as a
factor on the input's pixels, not the pixels: the ring keeps the input's own texture, nothing is seen twice, and where
nothing changes the ring does not either. Beyond the ring the factor goes over into that of the skin as a whole, so that
neck and ears take the face's new tone.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.color import in_three_channels
from graphface.nodes.face_scale import face_scale
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Features, FloatArray, Image, Landmarks, Mask

_FLOOR = 0.05
"""Added to both sides of the factor: black stays near black."""


_MOST = 2.0
"""Largest magnitude of the factor's logarithm."""


_TEXTURE = np.float32(0.08)
"""What differs by less from its surroundings is texture, which brighter skin shows no stronger."""


@node("makeup.boundary")
def boundary(
    photo: Image,
    painted: Image,
    core: Mask,
    features: Features,
    landmarks: Landmarks,
    *,
    ring: Annotated[float, Field(ge=0, le=2)] = 0.15,
    resolution: Annotated[int, Field(ge=8, le=256)] = 64,
) -> Image:
    """The painted face, continued over the whole picture.

    Args:
        photo: the input. painted: valid where `core` is not 0.
        ring: width of the mirrored ring, in inter-ocular distances (the paper's 30 pixels on its photos).
        resolution: pixels per inter-ocular distance of the copy on which the change is continued.
    """
    import cv2

    if not (core > 0).any():
        return photo
    copy = face_scale(landmarks, core.shape, resolution)
    unit = copy.interocular
    weight, before = copy.down(core), copy.down(photo.pixels)
    change = np.log(np.maximum(copy.down(painted.pixels), 0) + np.float32(_FLOOR))
    change -= np.log(np.maximum(before, 0) + np.float32(_FLOOR))
    known = weight >= min(0.5, float(weight.max()))
    bare = known & (copy.down(features.any_of("eyes", "mouth", "lips", "lids", "brows")) < 0.1)
    bare = bare if bare.any() else known
    change = np.clip(change, -_MOST, _MOST)
    around = _averaged(change, bare, 0.4 * unit)
    change[known & ~bare] = around[known & ~bare]  # lips and brows have no place in the ring
    continued = _continued(change, known, around, max(ring * unit, 1e-3), unit)
    factor = copy.up(np.exp(continued))
    smooth = cv2.GaussianBlur(before, (0, 0), max(0.03 * unit, 0.5), borderType=cv2.BORDER_REPLICATE)
    broad = copy.up(np.asarray(smooth, np.float32))
    # What shines more than skin does is no skin color: it moves with the skin, and is not multiplied.
    matte = np.quantile(before[bare], 0.8, axis=0).astype(np.float32)
    opening = np.maximum(features.eyes, features.mouth)
    pixels = np.empty_like(photo.pixels)

    def strip(rows: slice) -> None:
        own, more = photo.pixels[rows], factor[rows] - 1
        if opening[rows].any():  # teeth and eyes are no skin, whatever its tone
            more *= in_three_channels(1 - opening[rows])
        # Where it gets darker everything in the pixel does; where it gets brighter, pores and grain stay what they are.
        off = broad[rows] - own
        skin = own + off * np.clip(2 - np.abs(off) * (1 / _TEXTURE), 0, 1) * (more > 0)
        beyond = own + _limited((np.minimum(skin, matte) + np.float32(_FLOOR)) * more, own)
        pixels[rows] = beyond + in_three_channels(core[rows]) * (painted.pixels[rows] - beyond)

    by_strips(strip, pixels.shape)
    return photo.with_pixels(pixels)


def _limited(change: FloatArray, pixels: FloatArray) -> FloatArray:
    """The change, bent to stay within the room that each value has left; small changes pass as they are."""
    room = np.where(change > 0, 1 - pixels, pixels)
    np.maximum(room, np.float32(1e-4), out=room)
    used = np.divide(change, room, out=room)
    np.square(used, out=used)
    np.square(used, out=used)
    used += 1
    np.sqrt(used, out=used)
    np.sqrt(used, out=used)
    return np.asarray(np.divide(change, used, out=used), np.float32)


def _averaged(change: FloatArray, bare: NDArray[np.bool_], reach: float) -> FloatArray:
    """The change of the bare skin around every pixel; far from the face, of all of it."""
    import cv2

    whole = np.median(change[bare], axis=0).astype(np.float32)
    near = np.dstack([np.where(bare[..., None], change - whole, 0), bare.astype(np.float32)])
    near = cv2.GaussianBlur(near, (0, 0), max(reach, 0.5), borderType=cv2.BORDER_CONSTANT)
    return np.asarray(whole + near[..., :3] / (near[..., 3:] + np.float32(0.05)), np.float32)


def _continued(
    change: FloatArray, known: NDArray[np.bool_], around: FloatArray, ring: float, unit: float
) -> FloatArray:
    """The change, mirrored at the boundary within `ring` pixels of it, then going over into that of the skin around."""
    import cv2

    distance, label = cv2.distanceTransformWithLabels(
        (~known).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    y, x = np.mgrid[: known.shape[0], : known.shape[1]].astype(np.float32)
    at = np.zeros((int(label.max()) + 1, 2), np.float32)
    at[label[known]] = np.stack([x[known], y[known]], axis=1)
    nearest = at[label]
    mirrored = 2 * nearest - np.dstack([x, y])
    inside = cv2.remap(known.astype(np.float32), mirrored, None, cv2.INTER_LINEAR, borderValue=0)[..., None]  # type: ignore[call-overload]
    values = np.where(known[..., None], change, around)
    reflected = cv2.remap(values, mirrored, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)  # type: ignore[call-overload]
    edge = cv2.remap(values, nearest, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)  # type: ignore[call-overload]
    reflected = edge + np.clip(inside * 2 - 1, 0, 1) * (reflected - edge)
    near = cv2.GaussianBlur(np.where(known[..., None], change, reflected), (0, 0), max(0.03 * unit, 0.5))
    t = np.clip(distance / ring, 0, 1)[..., None]
    t = t * t * (3 - 2 * t)
    return np.asarray(near + t * (around - near), np.float32)
