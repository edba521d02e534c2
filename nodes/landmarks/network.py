"""Running a TensorFlow Lite network with OpenCV.

A `cv2.dnn.Net` holds its input and the outputs of its layers, so every thread has its own. The classic engine is
requested explicitly: the new one of OpenCV 5.0 loses the detectors' second output.
"""

from __future__ import annotations

import threading
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from graphface.assets.asset import Asset
from graphface.nodes.landmarks.weights import weights_path
from graphface.nodes.types import FloatArray

_threads = threading.local()


def run_network(asset: Asset, pixels: FloatArray) -> dict[str, FloatArray]:
    """One pass of the network `asset` over a picture.

    Args:
        pixels: float32 (n, n, 3) RGB in the range that the network expects.

    Returns:
        Every output by its name, in the network's own shape.
    """
    net = _net(asset)
    blob = np.ascontiguousarray(pixels.transpose(2, 0, 1)[None], dtype=np.float32)
    net.setInput(blob)
    names = net.getUnconnectedOutLayersNames()
    return {name: np.array(out, dtype=np.float32) for name, out in zip(names, net.forward(names), strict=True)}


def sigmoid(logits: NDArray[np.float32]) -> NDArray[np.float32]:
    """1 / (1 + exp(-x)), with x clamped to ±80: exp of more overflows float32."""
    return np.asarray(1 / (1 + np.exp(-np.clip(logits, -80, 80))), dtype=np.float32)


def _net(asset: Asset) -> Any:
    nets: dict[str, Any] = _threads.__dict__.setdefault("nets", {})
    if asset.name not in nets:
        path = str(weights_path(asset))  # from a buffer OpenCV always uses the new engine
        nets[asset.name] = cv2.dnn.readNetFromTFLite(path, engine=cv2.dnn.ENGINE_CLASSIC)
    return nets[asset.name]
