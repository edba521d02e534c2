"""Labels by a network that has seen many photos, beside `masks.classify`, which learns on this one alone.

MediaPipe's multi-class selfie segmentation (Apache-2.0) labels a 256 x 256 picture as background, hair, body skin, face
skin, clothes and accessories. It knows long hair on shoulders, fair hair, hats and hands for what they are. What is no
photograph it does not know: path-traced heads with painted hair it labels far worse than the classifiers
(`graphface bench masks --labels network`), so it is a choice, not the default.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from graphface import UsageError, node
from graphface.assets.asset import asset_path
from graphface.nodes.head_shape import pose_of
from graphface.nodes.masks.connected import apart, roots
from graphface.nodes.masks.prior import Layout, layout_of, log_sum_exp
from graphface.nodes.masks.weights import SELFIE_MULTICLASS
from graphface.nodes.masks.window import Window, window_about
from graphface.nodes.network_pixels import network_pixels
from graphface.nodes.types import FloatArray, HeadMasks, Image, Landmarks, Mask, Segmentation

SIDE = 256


HAIR, SKIN = 1, slice(2, 4)
"""Of the network's six classes; the others are background, clothes and accessories."""


WORKING = 42
"""Pixels per inter-ocular distance that labels are cleared of other people at: about what the network sees."""


BESIDE = (1.2, 1.5)
"""Distance from the middle of the face, in inter-ocular distances, from and up to which somebody else may stand. Long
hair that falls nearer than that is never taken for another's: a lock under a shadow hangs by little, and would jump
with noise."""


_threads = threading.local()


_starting = threading.Lock()


@node("masks.network")
def network(
    photo: Image,
    landmarks: Landmarks,
    masks: HeadMasks,
    hair_seeds: Mask | None = None,
    *,
    mirrored: bool = True,
    certainty: Annotated[float, Field(gt=0, le=20)] = 2.5,
) -> Segmentation:
    """Face, hair and background of a whole photo, by MediaPipe's selfie segmentation.

    The network sees the part of the photo about the face (see `masks.window`), turned upright by quarter turns. What
    the conservative mask holds is face, whatever is painted on it; what does not hang on this head is background.

    Args:
        photo: any size and encoding. masks: from the projected geometry. hair_seeds: what is hair for certain.
        mirrored: average with the labels of the mirrored picture: twice the time, half the jump under noise.
        certainty: the network's logits are multiplied by it. At 1 the middle of a head of hair is 0.92 hair, which as
            an alpha would let the background through.

    Raises:
        UsageError: LiteRT is not installed. AssetUnavailable: see `graphface.assets.asset.asset_path`.
    """
    import cv2

    window, chances = window_chances(photo, landmarks, mirrored=mirrored, certainty=certainty)
    small = np.asarray(cv2.resize(chances, (window.width, window.height), interpolation=cv2.INTER_LINEAR), np.float32)
    hair, face = small[..., HAIR], small[..., SKIN].sum(axis=2)
    sure = window.shrunk(masks.conservative)
    face = face + sure * np.maximum(1 - hair - face, 0)
    layout = layout_of(landmarks, window)
    face, hair = _of_this_head(face, hair, layout, landmarks.interocular * window.scale)
    if hair_seeds is not None:
        certain = window.shrunk(hair_seeds)
        face, hair = face * (1 - certain), np.maximum(hair, certain)
    shape = photo.pixels.shape
    face, hair = (window.enlarged(np.clip(labels, 0, 1), shape, beyond=0) for labels in (face, hair))
    return Segmentation(face, hair, np.maximum(1 - face - hair, 0))


def window_chances(
    photo: Image, landmarks: Landmarks, *, mirrored: bool = True, certainty: float = 1.0
) -> tuple[Window, FloatArray]:
    """The part of a photo that the network is shown, and the probabilities 256 x 256 x 6 of that part."""
    window = window_about(landmarks, photo.pixels.shape, WORKING)
    turns = _quarter_turns(landmarks)
    seen = network_pixels(np.ascontiguousarray(photo.pixels[window.part]), photo.encoding)
    chances = np.rot90(class_chances(np.rot90(seen, turns), mirrored, certainty), -turns)
    return window, np.ascontiguousarray(chances)


def class_chances(pixels: FloatArray, mirrored: bool, certainty: float = 1.0) -> FloatArray:
    """The network's probabilities, float32 256 x 256 x 6, of an upright picture h x w x 3 in [0, 1]."""
    import cv2

    shrinks = min(pixels.shape[:2]) > SIDE
    method = cv2.INTER_AREA if shrinks else cv2.INTER_LINEAR
    seen = np.asarray(cv2.resize(np.ascontiguousarray(pixels), (SIDE, SIDE), interpolation=method), np.float32)
    logits = _logits(seen)
    if mirrored:
        logits = np.float32(0.5) * (logits + _logits(seen[:, ::-1])[:, ::-1])
    logits = np.float32(certainty) * logits
    return np.asarray(np.exp(logits - log_sum_exp(logits)), np.float32)


def _of_this_head(face: FloatArray, hair: FloatArray, layout: Layout, unit: float) -> tuple[FloatArray, FloatArray]:
    """Without the skin and hair of other people, which stand beside this head and do not hang on it."""
    hangs_on = roots(layout)
    beside = np.clip((np.abs(layout.right) - BESIDE[0]) / (BESIDE[1] - BESIDE[0]), 0, 1)
    strays = face * apart(face, hangs_on.skin, unit), hair * apart(hair, hangs_on.hair, unit)
    return face - beside * strays[0], hair - beside * strays[1]


def _quarter_turns(landmarks: Landmarks) -> int:
    """Counter-clockwise quarter turns that bring the face nearest to upright."""
    up = pose_of(landmarks).rotation[:2, 1]
    leaning = np.arctan2(up[0], up[1])  # of the head's own up to the picture's right
    return round(float(leaning) / (np.pi / 2)) % 4


def _logits(pixels: FloatArray) -> FloatArray:
    net = _interpreter()
    net.set_tensor(net.get_input_details()[0]["index"], np.ascontiguousarray(pixels[None], np.float32))
    net.invoke()
    return np.asarray(net.get_tensor(net.get_output_details()[0]["index"])[0], np.float32)


def _interpreter() -> Any:
    """This thread's interpreter: one keeps its input and output, and serves one thread at a time."""
    if not hasattr(_threads, "net"):
        try:
            from ai_edge_litert.interpreter import Interpreter
        except ImportError:
            raise UsageError("masks.network needs LiteRT: pip install 'graphface[network]'") from None
        path = str(asset_path(SELFIE_MULTICLASS))
        with _starting, _without_chatter():
            net = Interpreter(path, num_threads=2)
            net.allocate_tensors()
        _threads.net = net
    return _threads.net


@contextmanager
def _without_chatter() -> Iterator[None]:
    """LiteRT writes to file descriptor 2 which backend it chose, and knows no way to be asked not to."""
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
