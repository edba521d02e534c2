"""MediaPipe's multi-class selfie segmentation (Apache-2.0), run with LiteRT.

The network labels a 256 x 256 picture as background, hair, body skin, face skin, clothes and accessories.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from graphface import UsageError
from graphface.assets.asset import asset_path
from graphface.nodes.masks.logits import softmax
from graphface.nodes.masks.weights import SELFIE_MULTICLASS
from graphface.nodes.types import FloatArray

SIDE = 256
"""Pixels of the network's square input."""


HAIR, SKIN = 1, slice(2, 4)
"""Channels of the network's output; the others are background, clothes and accessories."""


_threads = threading.local()


_starting = threading.Lock()


def class_probabilities(pixels: FloatArray, mirrored: bool, inverse_temperature: float = 1.0) -> FloatArray:
    """The network's probabilities, float32 256 x 256 x 6, of an upright picture h x w x 3 in [0, 1].

    Args:
        mirrored: average with the logits of the mirrored picture.
        inverse_temperature: factor on the logits.

    Raises:
        UsageError: LiteRT is not installed. AssetUnavailable: see `graphface.assets.asset.asset_path`.
    """
    import cv2

    shrinks = min(pixels.shape[:2]) > SIDE
    method = cv2.INTER_AREA if shrinks else cv2.INTER_LINEAR
    square = np.asarray(cv2.resize(np.ascontiguousarray(pixels), (SIDE, SIDE), interpolation=method), np.float32)
    logits = _logits(square)
    if mirrored:
        logits = np.float32(0.5) * (logits + _logits(square[:, ::-1])[:, ::-1])
    return softmax(np.float32(inverse_temperature) * logits)


def _logits(pixels: FloatArray) -> FloatArray:
    net = _interpreter()
    net.set_tensor(net.get_input_details()[0]["index"], np.ascontiguousarray(pixels[None], np.float32))
    net.invoke()
    return np.asarray(net.get_tensor(net.get_output_details()[0]["index"])[0], np.float32)


def _interpreter() -> Any:
    """This thread's interpreter: one holds its input and output, so it serves one thread at a time."""
    if not hasattr(_threads, "net"):
        try:
            from ai_edge_litert.interpreter import Interpreter
        except ImportError:
            raise UsageError("masks.network needs LiteRT: pip install 'graphface[network]'") from None
        path = str(asset_path(SELFIE_MULTICLASS))
        with _starting, _without_stderr():
            net = Interpreter(path, num_threads=2)
            net.allocate_tensors()
        _threads.net = net
    return _threads.net


@contextmanager
def _without_stderr() -> Iterator[None]:
    """LiteRT writes the backend it chose to file descriptor 2, and has no setting to turn that off."""
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
