"""The network that refines normals and finds cast shadows: a small U-Net (`graphface.nodes.unet`) on a face's crop.

It sees the picture, the fitted normals, the face mask, and what the estimated light makes of the fitted normals. It
gives what has to be added to the normals, and where something stands before the strongest lamp. It was learned from
path-traced heads: `graphface models normals`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from graphface.nodes.harmonics import basis
from graphface.nodes.network_pixels import network_pixels
from graphface.nodes.network_weights import Network, read_network
from graphface.nodes.surface.face_crop import SIZE, FaceCrop
from graphface.nodes.types import FloatArray, Image, Lighting, Mask, Surface
from graphface.nodes.unet import Weights, unet

WIDTHS = (24, 40, 64, 96)
"""Channels at each level, finest first."""


COLORS, NORMALS, COVERAGE, MASK, SHADING, LIGHT, PLACE, CHANNELS = 0, 3, 6, 7, 8, 9, 12, 14
"""First channel of each kind of input, and their count."""


OF_PICTURE = (*range(COLORS, NORMALS), *range(SHADING, PLACE))
"""The channels that depend on the picture's values."""


OUTPUTS = 4
"""The correction of the normals, and the logit of the cast shadow."""


NETWORK = Network("graphface-normals-2", "normals network", WIDTHS, 4 * CHANNELS, "graphface models normals")


_BRIGHTEST = 3.0
"""Colors and shading relative to the face's mean are clipped to this."""

_LEAST_COVERED = 0.3


@dataclass(frozen=True)
class NormalWeights:
    """Weights of a normals network by layer; as a graph input, a file that `graphface models normals` wrote."""

    arrays: Weights


SHIPPED = Path(__file__).with_name("normals.safetensors")
"""A constant of the module, so that its content is part of the fingerprint of the code that uses it."""


@cache
def shipped_weights() -> Weights:
    """The weights that come with the package."""
    return read_network(SHIPPED, NETWORK)


def network_input(crop: FaceCrop, photo: Image, surface: Surface, mask: Mask, light: Lighting) -> FloatArray:
    """What the network sees, float32 SIZE x SIZE x CHANNELS, every channel of about unit range."""
    pixels = _pixels(crop, photo)
    weight = crop.sampled(mask)
    covered = crop.sampled(surface.coverage)
    normals = crop.turned(crop.sampled(surface.normals))
    length = np.sqrt(np.square(normals).sum(axis=2, keepdims=True))
    on = covered[..., None] > _LEAST_COVERED
    normals = np.asarray(normals / np.maximum(length, 1e-3) * on, np.float32)
    shading = _shading(crop.turned(normals, back=True), light)
    total = max(float(weight.sum()), 1.0)
    brightness = max(float((pixels.mean(axis=2) * weight).sum()) / total, 1e-2)
    mean = max(float((shading * weight).sum()) / total, 1e-2)
    axes = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]], np.float32)
    seen = np.clip(_of_light(axes, light) / mean, -_BRIGHTEST, _BRIGHTEST)
    towards = crop.turned(np.array([(seen[0] - seen[1]) / 2, (seen[2] - seen[3]) / 2, seen[4] / 2], np.float32))
    place = np.mgrid[:SIZE, :SIZE].astype(np.float32)[::-1] / SIZE - 0.5
    channels = [
        np.clip(pixels / brightness, 0, _BRIGHTEST) - 1,
        normals,
        covered[..., None],
        weight[..., None],
        np.clip(shading / mean, 0, _BRIGHTEST)[..., None] - 1,
        np.broadcast_to(towards, (SIZE, SIZE, 3)),
        place.transpose(1, 2, 0),
    ]
    return np.concatenate(channels, axis=2, dtype=np.float32)


def corrections(seen: FloatArray, weights: Weights) -> tuple[FloatArray, FloatArray]:
    """What the network says of a crop.

    Returns:
        What is to be added to its normals, float32 SIZE x SIZE x 3, in the crop's axes; and the probability that
        something stands before the strongest lamp, SIZE x SIZE, 0..1.
    """
    said = unet(unshuffled(seen), weights, len(WIDTHS))
    return said[..., :3], np.asarray(1 / (1 + np.exp(-np.clip(said[..., 3], -30, 30))), np.float32)


def unshuffled(values: FloatArray) -> FloatArray:
    """2h x 2w x C to h x w x 4C: the four pixels of a cell, channel by channel."""
    height, width, channels = values.shape
    cells = values.reshape(height // 2, 2, width // 2, 2, channels).transpose(0, 2, 4, 1, 3)
    return np.ascontiguousarray(cells.reshape(height // 2, width // 2, 4 * channels))


def _pixels(crop: FaceCrop, photo: Image) -> FloatArray:
    """The crop of the photo as networks expect it, SIZE x SIZE x 3."""
    if photo.encoding == "srgb":
        return network_pixels(crop.sampled(photo.pixels), photo.encoding)
    top, bottom, left, right = window = crop.window(photo.pixels.shape)
    return crop.sampled_window(network_pixels(photo.pixels[top:bottom, left:right], photo.encoding), window)


def _shading(normals: FloatArray, light: Lighting) -> FloatArray:
    """What the light makes of normals, one value a pixel; 0 where there is none."""
    values = _of_light(normals.reshape(-1, 3), light).reshape(normals.shape[:2])
    return np.asarray(np.maximum(values, 0) * (normals != 0).any(axis=2), np.float32)


def _of_light(normals: FloatArray, light: Lighting) -> FloatArray:
    values = basis(normals, light.order) @ light.coefficients
    return np.asarray(values.mean(axis=1) if values.ndim == 2 else values, np.float32)
