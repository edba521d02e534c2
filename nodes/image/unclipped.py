"""Highlight reconstruction: the color that bright pixels lost because a camera or an editor clipped a channel.

Where one channel is clipped and the others are not, the color of the pixel is wrong: bright skin turns yellow, then
white. At its own brightness that hardly shows, but light taken away from it leaves a yellow-green patch. As raw
converters do, such pixels are reconstructed from the channels that are not clipped and from the color around them.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import face_scale
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Image, Landmarks, Mask

_LEAST = np.float32(1e-3)


_WIDE, _WIDE_WEIGHT = 4.0, 0.02
"""Width of a second average, relative to the first, and its weight: it decides where the first one has only clipped
pixels."""


@node("image.unclipped")
def unclipped(
    photo: Image,
    landmarks: Landmarks,
    face: Mask | None = None,
    *,
    begin: Annotated[float, Field(ge=0, le=1)] = 0.94,
    end: Annotated[float, Field(ge=0, le=1)] = 0.99,
    sigma: Annotated[float, Field(gt=0, le=2), Formerly("reach")] = 0.1,
    largest_gain: Annotated[float, Field(ge=1, le=4), Formerly("most")] = 1.5,
    resolution: Annotated[int, Field(ge=8, le=256)] = 32,
) -> Image:
    """The photo with clipped channels raised beyond 1, to the color around them at the pixel's own brightness.

    Args:
        face: where skin is, H x W; nothing else is raised. A white wall or a lamp is not skin that lost its color, and
            in the color of a face it would be a stain. On skin full white is raised too. None raises every pixel that
            has a channel left.
        begin, end: values between which the confidence in a channel falls from 1 to 0. JPEG leaves clipped pixels some
            steps below 1.
        sigma: standard deviation of the average color around, in inter-ocular distances.
        largest_gain: largest factor by which a channel is raised.
        resolution: pixels per inter-ocular distance of the copy on which colors are averaged.

    Returns:
        The same values where no channel is clipped; elsewhere clipped channels are raised.
    """
    import cv2

    pixels = photo.pixels
    if pixels.size == 0 or pixels.max() <= begin:
        return photo
    span = np.float32(max(end - begin, 1e-3))

    def confidence(values: FloatArray) -> FloatArray:
        return np.asarray(np.clip((np.float32(begin) + span - values) / span, 0, 1), np.float32)

    copy = face_scale(landmarks, pixels.shape, resolution)
    small = copy.down(pixels)
    # Pixels nearly as bright as the highlight are likely to be of its material. A clipped pixel has no color to give.
    weight = (confidence(small).min(axis=2) * np.square(channel_mean(small)) + np.float32(1e-6))[..., None]
    sums = np.concatenate([small * weight, weight], axis=2)
    width = max(sigma * copy.interocular, 0.5)
    sums = blurred(sums, width) + np.float32(_WIDE_WEIGHT) * blurred(sums, _WIDE * width)
    color_around = copy.up(sums[..., :3] / sums[..., 3:])
    raised = pixels.copy()

    def reconstruct(rows: slice) -> None:
        red, green, blue = cv2.split(pixels[rows])
        places = np.flatnonzero(np.maximum(np.maximum(red, green), blue) > begin)
        part = pixels[rows].reshape(-1, 3).take(places, axis=0)
        color = np.maximum(color_around[rows].reshape(-1, 3).take(places, axis=0), _LEAST)
        known = confidence(part)
        brightness = (known * part).sum(axis=1) / np.maximum((known * color).sum(axis=1), _LEAST)
        wanted = np.clip(color * brightness[:, None], part, part * np.float32(largest_gain))
        certainty = np.minimum(known.sum(axis=1), 1)[:, None]
        if face is not None:
            # All channels clipped: the least light of the skin's color that reaches them all.
            reaching = color * (part / color).max(axis=1, keepdims=True)
            wanted += (1 - certainty) * (np.minimum(reaching, part * np.float32(largest_gain)) - wanted)
            certainty = face[rows].reshape(-1, 1).take(places, axis=0)
        raised[rows].reshape(-1, 3)[places] = part + (1 - known) * certainty * (wanted - part)

    by_strips(reconstruct, raised.shape)
    return photo.with_pixels(raised)
