"""From linear radiance to a picture as phones and cameras make it: exposure, white balance, tone curve, noise, JPEG."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.color import encode_srgb
from graphface.nodes.types import FloatArray

_WEIGHTS = np.array([0.2126, 0.7152, 0.0722], np.float32)


def developed(radiance: FloatArray, on_face: NDArray[np.bool_], random: np.random.Generator) -> NDArray[np.uint8]:
    """sRGB pixels, uint8 H x W x 3.

    Args:
        radiance: linear, H x W x 3. on_face: H x W, the pixels that are exposed for.
    """
    import cv2

    u = random.uniform
    face = radiance[on_face] if on_face.any() else radiance.reshape(-1, 3)
    white = np.maximum(face.mean(axis=0) / max(float(face.mean()), 1e-6), 0.05)
    balance = np.exp(random.normal(size=3) * 0.05) / white ** u(0, 0.25)
    level = np.percentile(face @ _WEIGHTS, 80)
    linear = np.maximum(radiance * (balance * u(0.16, 0.75) / max(float(level), 1e-5)), 0).astype(np.float32)
    pixels = np.asarray(_toned(linear, random), np.float32)
    grey = (pixels @ _WEIGHTS)[..., None]
    pixels = np.asarray(grey + (pixels - grey) * u(0.75, 1.3), np.float32)
    if u() < 0.4:  # sharpened by the camera
        blurred = cv2.GaussianBlur(pixels, (0, 0), u(0.7, 1.5))
        pixels = np.asarray(pixels + u(0.2, 1.0) * (pixels - blurred), np.float32)
    elif u() < 0.4:
        pixels = np.asarray(cv2.GaussianBlur(pixels, (0, 0), u(0.3, 0.9)), np.float32)
    shot = random.normal(size=pixels.shape).astype(np.float32)
    if u() < 0.5:  # noise after a camera's own filter is coarse, and mostly in color
        shot = np.asarray(cv2.GaussianBlur(shot, (0, 0), 0.7) * 1.8, np.float32)
    noisy = pixels + shot * u(0, 0.018) * np.sqrt(np.clip(pixels, 0.05, 1))
    stored = np.round(np.clip(noisy, 0, 1) * 255).astype(np.uint8)
    if u() < 0.75:
        quality = [cv2.IMWRITE_JPEG_QUALITY, int(u(45, 97))]
        coded = cv2.imencode(".jpg", stored[..., ::-1], quality)[1]
        stored = np.asarray(cv2.imdecode(coded, cv2.IMREAD_COLOR), np.uint8)[..., ::-1].copy()
    return stored


def _toned(linear: FloatArray, random: np.random.Generator) -> FloatArray:
    """sRGB, a power, an S-shaped curve, or one that lifts shadows and rolls highlights off."""
    kind, u = random.random(), random.uniform
    if kind < 0.4:
        return encode_srgb(np.minimum(linear, 1))
    if kind < 0.55:
        return linear ** np.float32(1 / u(1.9, 2.6))
    if kind < 0.8:
        power = np.clip(linear, 0, 1) ** np.float32(1 / 2.2)
        share = u(0.1, 0.6)
        return np.asarray(power * (1 - share) + share * (3 * power**2 - 2 * power**3), np.float32)
    shoulder = u(0.6, 2.0)
    rolled = linear * (1 + linear / shoulder**2) / (1 + linear)
    lifted = np.minimum(rolled * u(1.2, 1.8), 1) ** np.float32(u(0.8, 1.0))
    return encode_srgb(np.asarray(lifted, np.float32))
