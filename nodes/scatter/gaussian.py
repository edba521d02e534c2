"""The paper's scattering: the shading, smoothed by a Gaussian."""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.scatter.smoothed_change import smoothed_change
from graphface.nodes.types import FloatArray, Image, Landmarks, Scene, Shading, Surface

_LEAST_SIGMA = 0.3
"""Grid points; a narrower Gaussian changes nothing."""


@node("scatter.gaussian")
def gaussian(
    shading: Shading, estimated: Shading, surface: Surface, landmarks: Landmarks, photo: Image, scene: Scene
) -> Shading:
    """One Gaussian of `scene.scatter` inter-ocular distances for all channels, normalized over the surface.

    Args:
        shading, estimated: under the new and the photo's own light, H x W or H x W x 3, in the photo's encoding.

    Returns:
        float32 of the shape of `shading`, or H x W x 3 if only `estimated` is colored.
    """
    import cv2

    def smooth(change: FloatArray, coverage: FloatArray, depth: FloatArray, resolution: float) -> FloatArray:
        sigma = scene.scatter * resolution
        if sigma < _LEAST_SIGMA:
            return change
        weight = cv2.GaussianBlur(coverage, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE)
        sums = cv2.GaussianBlur(change * coverage[..., None], (0, 0), sigma, borderType=cv2.BORDER_REPLICATE)
        return np.asarray(sums.reshape(change.shape) / weight.clip(1e-4)[..., None], np.float32)

    return smoothed_change(shading, estimated, surface, landmarks, photo, smooth)
