"""Highlights that a camera or an editor clipped, given back the color that they have lost.

Where one channel has reached its end and the others have not, the pixel's color is wrong: bright skin turns yellow,
then white. As it is that is bright enough, but light taken away from it leaves a yellow-green patch. Raw converters
reconstruct such pixels from the channels that still tell something and the color around; so does this.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.blur import blurred
from graphface.nodes.color import channel_mean
from graphface.nodes.face_scale import face_scale
from graphface.nodes.strips import by_strips
from graphface.nodes.types import FloatArray, Image, Landmarks

_LEAST = np.float32(1e-3)


_FAR, _FAR_SHARE = 4.0, 0.02
"""A second, wider average, and its weight: it decides where the near one has seen nothing but clipped pixels."""


@node("image.unclipped")
def unclipped(
    photo: Image,
    landmarks: Landmarks,
    *,
    begin: Annotated[float, Field(ge=0, le=1)] = 0.94,
    end: Annotated[float, Field(ge=0, le=1)] = 0.99,
    reach: Annotated[float, Field(gt=0, le=2)] = 0.1,
    most: Annotated[float, Field(ge=1, le=4)] = 1.5,
    resolution: Annotated[int, Field(ge=8, le=256)] = 32,
) -> Image:
    """The photo with clipped channels raised beyond 1, to what the others and the color around them say.

    Args:
        begin, end: values between which a channel passes from trusted to clipped. JPEG leaves clipped pixels some
            steps below 1.
        reach: of the surroundings whose color is taken, in inter-ocular distances.
        most: a channel is raised by this factor at the most.
        resolution: pixels per inter-ocular distance of the copy on which colors around are averaged.

    Returns:
        The same values where no channel is clipped, or where all are; else some of them are larger.
    """
    import cv2

    pixels = photo.pixels
    if pixels.size == 0 or pixels.max() <= begin:
        return photo
    copy = face_scale(landmarks, pixels.shape, resolution)
    span = np.float32(max(end - begin, 1e-3))

    def trust(values: FloatArray) -> FloatArray:
        return np.asarray(np.clip((np.float32(begin) + span - values) / span, 0, 1), np.float32)

    small = copy.down(pixels)
    # Near to the highlight in brightness is near in kind; what has a clipped channel has no color to give.
    weight = (trust(small).min(axis=2) * np.square(channel_mean(small)) + np.float32(1e-6))[..., None]
    sums = np.concatenate([small * weight, weight], axis=2)
    sigma = max(reach * copy.interocular, 0.5)
    sums = blurred(sums, sigma) + np.float32(_FAR_SHARE) * blurred(sums, _FAR * sigma)
    around = copy.up(sums[..., :3] / sums[..., 3:])
    raised = pixels.copy()

    def reconstruct(rows: slice) -> None:
        red, green, blue = cv2.split(pixels[rows])
        places = np.flatnonzero(np.maximum(np.maximum(red, green), blue) > begin)
        part = pixels[rows].reshape(-1, 3).take(places, axis=0)
        usual = np.maximum(around[rows].reshape(-1, 3).take(places, axis=0), _LEAST)
        known = trust(part)
        brighter = (known * part).sum(axis=1) / np.maximum((known * usual).sum(axis=1), _LEAST)
        wanted = np.clip(usual * brighter[:, None], part, part * np.float32(most))
        told = np.minimum(known.sum(axis=1), 1)[:, None]
        raised[rows].reshape(-1, 3)[places] = part + (1 - known) * told * (wanted - part)

    by_strips(reconstruct, raised.shape)
    return photo.with_pixels(raised)
