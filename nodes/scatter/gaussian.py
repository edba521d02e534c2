"""The paper's scattering: the shading, smoothed."""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.scatter.change import smoothed_change
from graphface.nodes.types import FloatArray, Image, Landmarks, Scene, Shading, Surface


@node("scatter.gaussian")
def gaussian(
    shading: Shading, estimated: Shading, surface: Surface, landmarks: Landmarks, photo: Image, scene: Scene
) -> Shading:
    """One Gaussian of `scene.scatter` inter-ocular distances for all colors; nothing leaks in over the silhouette.

    Args:
        shading, estimated: under the new and the photo's own light, H x W or H x W x 3, in the photo's encoding.

    Returns:
        As `shading`; grey stays grey.
    """
    import cv2

    def blur(change: FloatArray, inside: FloatArray, depth: FloatArray, unit: float) -> FloatArray:
        sigma = scene.scatter * unit
        if sigma < 0.3:  # less than a pixel
            return change
        weight = cv2.GaussianBlur(inside, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE)
        sums = cv2.GaussianBlur(change * inside[..., None], (0, 0), sigma, borderType=cv2.BORDER_REPLICATE)
        floor = weight.clip(1e-4)
        return np.asarray(sums.reshape(change.shape) / floor[..., None], np.float32)

    return smoothed_change(shading, estimated, surface, landmarks, photo, blur)
