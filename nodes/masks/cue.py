"""A prior segmentation: rough face, hair and background by a small network that was trained on other photos.

The prior of `masks.prior` knows only the geometry of the face. The network also sees the picture. It distinguishes long
hair on shoulders from a dark suit, fair hair from skin and a hat from hair, and leaves exact edges to the classifiers
of this photo. It was trained on the labels of MediaPipe's selfie segmentation (`masks.network`), which is a hundred
times its size, and on the true labels of rendered heads; see the card beside the weights.
"""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.masks.label_network import label_scores
from graphface.nodes.masks.label_weights import LabelWeights, shipped_weights
from graphface.nodes.masks.logits import softmax
from graphface.nodes.masks.network_input import mirrored_input, network_input
from graphface.nodes.masks.upright_grid import UprightGrid, upright_grid
from graphface.nodes.network_pixels import network_pixels
from graphface.nodes.types import FloatArray, Image, Landmarks, Segmentation
from graphface.nodes.unet import Weights


@node("masks.cue")
def cue(
    photo: Image, landmarks: Landmarks, weights: LabelWeights | None = None, *, mirrored: bool = True
) -> Segmentation:
    """Face (with ears and neck), hair and background by the small network that comes with the package.

    Args:
        photo: any size and encoding; NaN is black.
        landmarks: any scheme; they give the position, size and roll of the head.
        weights: the shipped ones by default.
        mirrored: average with the labels of the mirrored picture. The result is then the same for both sides, and
            changes less with noise.

    Returns:
        Soft labels of the photo's size that sum to 1. Their edges are as wide as a twentieth of the inter-ocular
        distance. Background further than 3 such distances from the face.
    """
    grid = upright_grid(landmarks)
    arrays = shipped_weights() if weights is None else weights.arrays
    probabilities = label_probabilities(photo, landmarks, grid, arrays, mirrored)
    face, hair = (grid.unwarped(np.ascontiguousarray(probabilities[..., k]), photo.pixels.shape) for k in range(2))
    return Segmentation(face, hair, np.maximum(1 - face - hair, 0))


def label_probabilities(
    photo: Image, landmarks: Landmarks, grid: UprightGrid, weights: Weights, mirrored: bool
) -> FloatArray:
    """Probabilities of face, hair and background on the grid, float32 HEIGHT x WIDTH x 3."""
    pixels = network_pixels(grid.sampled(photo.pixels), photo.encoding)
    cells = network_input(pixels, grid.inside(photo.pixels.shape), grid.layout(landmarks))
    scores = label_scores(cells, weights)
    if mirrored:
        scores = np.float32(0.5) * (scores + label_scores(mirrored_input(cells), weights)[:, ::-1])
    return softmax(scores)
