"""Labels by a network that was trained on many photos, beside `masks.classify`, which learns on this one alone.

MediaPipe's selfie segmentation (see `masks.selfie_network`) labels long hair on shoulders, fair hair, hats and hands
correctly. It was trained on photographs: path-traced heads with painted hair it labels far worse than the classifiers
(`graphface bench masks --labels network`), so it is an option and not the default.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.head_shape import pose_of
from graphface.nodes.masks.connected import disconnected, seeds_of
from graphface.nodes.masks.layout import Layout, layout_of
from graphface.nodes.masks.selfie_network import HAIR, SKIN, class_probabilities
from graphface.nodes.masks.window import Window, window_about
from graphface.nodes.network_pixels import network_pixels
from graphface.nodes.types import FloatArray, HeadMasks, Image, Landmarks, Mask, Segmentation

RESOLUTION = 42
"""Pixels per inter-ocular distance at which other people are removed: about the network's own resolution."""


BESIDE = (1.2, 1.5)
"""Distances from the middle of the face, in inter-ocular distances, between which the removal of other people sets in.
Long hair that falls nearer is always kept: a lock in a shadow is only weakly connected, and would jump with noise."""


@node("masks.network")
def network(
    photo: Image,
    landmarks: Landmarks,
    masks: HeadMasks,
    hair_seeds: Mask | None = None,
    *,
    mirrored: bool = True,
    inverse_temperature: Annotated[float, Field(gt=0, le=20), Formerly("certainty")] = 2.5,
) -> Segmentation:
    """Face, hair and background of a whole photo, by MediaPipe's selfie segmentation.

    The network sees the part of the photo about the face (see `masks.window`), rotated upright by quarter turns. The
    conservative mask is face, whatever is painted on it. Skin and hair that are not connected to this head are
    background.

    Args:
        photo: any size and encoding. masks: from the projected geometry. hair_seeds: what is hair for certain.
        mirrored: average with the labels of the mirrored picture: twice the time, half the change under noise.
        inverse_temperature: factor on the network's logits. At 1 the middle of a head of hair is 0.92 hair, which as an
            alpha would let the background through.

    Raises:
        UsageError: LiteRT is not installed. AssetUnavailable: see `graphface.assets.asset.asset_path`.
    """
    import cv2

    window, probabilities = window_probabilities(
        photo, landmarks, mirrored=mirrored, inverse_temperature=inverse_temperature
    )
    size = (window.width, window.height)
    small = np.asarray(cv2.resize(probabilities, size, interpolation=cv2.INTER_LINEAR), np.float32)
    hair, face = small[..., HAIR], small[..., SKIN].sum(axis=2)
    conservative = window.downsampled(masks.conservative)
    face = face + conservative * np.maximum(1 - hair - face, 0)
    layout = layout_of(landmarks, window)
    face, hair = _of_this_head(face, hair, layout, landmarks.interocular * window.scale)
    if hair_seeds is not None:
        certain = window.downsampled(hair_seeds)
        face, hair = face * (1 - certain), np.maximum(hair, certain)
    shape = photo.pixels.shape
    face, hair = (window.upsampled(np.clip(labels, 0, 1), shape, outside=0) for labels in (face, hair))
    return Segmentation(face, hair, np.maximum(1 - face - hair, 0))


def window_probabilities(
    photo: Image, landmarks: Landmarks, *, mirrored: bool = True, inverse_temperature: float = 1.0
) -> tuple[Window, FloatArray]:
    """The part of a photo that the network sees, and the probabilities 256 x 256 x 6 of that part.

    Args:
        mirrored, inverse_temperature: see `network`.
    """
    window = window_about(landmarks, photo.pixels.shape, RESOLUTION)
    turns = _quarter_turns(landmarks)
    pixels = network_pixels(np.ascontiguousarray(photo.pixels[window.part]), photo.encoding)
    probabilities = np.rot90(class_probabilities(np.rot90(pixels, turns), mirrored, inverse_temperature), -turns)
    return window, np.ascontiguousarray(probabilities)


def _of_this_head(face: FloatArray, hair: FloatArray, layout: Layout, unit: float) -> tuple[FloatArray, FloatArray]:
    """Face and hair without the skin and hair of people beside this head, which are not connected to it."""
    seeds = seeds_of(layout)
    beside = np.clip((np.abs(layout.right) - BESIDE[0]) / (BESIDE[1] - BESIDE[0]), 0, 1)
    others_face = face * disconnected(face, seeds.skin, unit)
    others_hair = hair * disconnected(hair, seeds.hair, unit)
    return face - beside * others_face, hair - beside * others_hair


def _quarter_turns(landmarks: Landmarks) -> int:
    """Counter-clockwise quarter turns that bring the face nearest to upright."""
    up = pose_of(landmarks).rotation[:2, 1]
    clockwise = np.arctan2(up[0], up[1])  # angle of the head's up axis from the picture's, radians
    return round(float(clockwise) / (np.pi / 2)) % 4
