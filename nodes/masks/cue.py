"""Where face, hair and background are, as a small network guesses it from many other photos.

The hand-set prior of `masks.prior` knows only where things tend to be; the network also looks. It knows long hair on
shoulders from a dark suit, fair hair from skin and a hat from hair, and leaves the exact edge to the classifiers of
this photo. Its teachers were MediaPipe's selfie segmentation (`masks.network`), which is a hundred times its size, and
the true labels of path-traced heads; the card beside the weights says which.
"""

from __future__ import annotations

import numpy as np

from graphface import node
from graphface.nodes.masks.label_network import Weights, label_scores
from graphface.nodes.masks.label_weights import LabelWeights, shipped_weights
from graphface.nodes.masks.network_input import mirror_image, shown
from graphface.nodes.masks.prior import log_sum_exp
from graphface.nodes.masks.upright import Upright, upright_of
from graphface.nodes.network_pixels import network_pixels
from graphface.nodes.types import FloatArray, Image, Landmarks, Segmentation


@node("masks.cue")
def cue(
    photo: Image, landmarks: Landmarks, weights: LabelWeights | None = None, *, mirrored: bool = True
) -> Segmentation:
    """Face (with ears and neck), hair and background by the small network that comes with the package.

    Args:
        photo: any size and encoding; what is not a number is black.
        landmarks: any scheme; they say where the head is, how large and how rolled.
        weights: the shipped ones by default.
        mirrored: average with the labels of the mirrored picture: right and left are told alike, and noise counts less.

    Returns:
        Soft labels of the photo's size that sum to 1; their edges are as wide as a twentieth of the inter-ocular
        distance. Background further than 3 such distances from the face.
    """
    grid = upright_of(landmarks)
    learned = shipped_weights() if weights is None else weights.arrays
    chances = label_chances(photo, landmarks, grid, learned, mirrored)
    face, hair = (grid.laid_back(np.ascontiguousarray(chances[..., k]), photo.pixels.shape) for k in range(2))
    return Segmentation(face, hair, np.maximum(1 - face - hair, 0))


def label_chances(photo: Image, landmarks: Landmarks, grid: Upright, weights: Weights, mirrored: bool) -> FloatArray:
    """Probabilities of face, hair and background on the grid, float32 HEIGHT x WIDTH x 3."""
    pixels = network_pixels(grid.sampled(photo.pixels), photo.encoding)
    cells = shown(pixels, grid.seen(photo.pixels.shape), grid.layout(landmarks))
    scores = label_scores(cells, weights)
    if mirrored:
        scores = np.float32(0.5) * (scores + label_scores(mirror_image(cells), weights)[:, ::-1])
    return np.asarray(np.exp(scores - log_sum_exp(scores)), np.float32)
