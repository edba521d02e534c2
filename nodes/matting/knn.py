"""Soft edges by the most similar pixels of the neighborhood: Chen, Li and Tang, KNN Matting, PAMI 2013.

A pixel's alpha is that of its K nearest neighbors in color and position: L = D - W with the affinity W of two pixels,
1 - |difference of features| / C. The graph has the band's pixels and the known pixels near the band.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import Formerly, node
from graphface.nodes.color import in_space
from graphface.nodes.matting.band import band_of, hard_alphas, soft_alphas, with_alphas
from graphface.nodes.matting.solve import solve_alphas
from graphface.nodes.types import FloatArray, Image, Landmarks, Segmentation

POSITION_WEIGHT = 0.5
"""Weight of position beside color, per inter-ocular distance."""


@node("matting.knn")
def knn(
    photo: Image,
    labels: Segmentation,
    landmarks: Landmarks,
    *,
    width: Annotated[float, Field(gt=0, le=2)] = 0.06,
    hair_width: Annotated[float, Field(gt=0, le=2), Formerly("strands")] = 0.15,
    neighbors: Annotated[int, Field(ge=2, le=50)] = 10,
    known_width: Annotated[float, Field(gt=0, le=1), Formerly("rim")] = 0.08,
    label_weight: Annotated[float, Field(ge=1e-9, le=1), Formerly("trust")] = 1e-2,
    tolerance: Annotated[float, Field(gt=0, le=0.1)] = 1e-3,
) -> Segmentation:
    """Alphas of face, hair and background, solved in the band where labels meet.

    Args:
        photo: the colors that alphas follow. labels: outside the band the most likely label is certain.
        width, hair_width: half the band's width in inter-ocular distances, in general and between hair and background.
        neighbors: K, of each pixel. known_width: of the known pixels beside the band that belong to the graph, in
            inter-ocular distances.
        label_weight: weight of the soft labels inside the band. tolerance: relative residual at which the solve stops.
    """
    import cv2
    from scipy.sparse import coo_matrix, diags, identity
    from scipy.spatial import cKDTree

    unit = max(landmarks.interocular, 1e-3)
    band = band_of(labels, unit, width=width, hair_width=hair_width)
    if band.empty:
        return labels
    near = cv2.distanceTransform((~band.unknown).astype(np.uint8), cv2.DIST_L2, 5) <= max(known_width * unit, 2)
    y, x = np.nonzero(near)
    points = _features(photo.pixels[band.part], y, x, unit)
    unknown = band.unknown[near]
    count = len(points)
    tree = cKDTree(points, compact_nodes=False, balanced_tree=False)
    index = tree.query(points[unknown], k=min(neighbors + 1, count), eps=0.5)[1].reshape(int(unknown.sum()), -1)
    sources = np.repeat(np.flatnonzero(unknown), index.shape[1])
    targets = index.reshape(-1)
    difference = np.abs(points[sources] - points[targets]).sum(axis=1)
    affinity = np.maximum(1 - difference / points.shape[1], 1e-3) * (sources != targets)
    graph = coo_matrix((affinity, (sources, targets)), shape=(count, count)).tocsr()
    graph = graph + graph.T
    laplacian = (diags(np.asarray(graph.sum(axis=1)).reshape(-1)) - graph).tocsr()[unknown]
    known = hard_alphas(labels, band.part)[near].astype(np.float64)
    guess = soft_alphas(labels, band)
    right = label_weight * guess - laplacian[:, ~unknown] @ known[~unknown]
    system = (laplacian[:, unknown] + label_weight * identity(len(guess))).tocsr()
    return with_alphas(labels, band, solve_alphas(system, right, guess, tolerance=tolerance))


def _features(pixels: FloatArray, y: NDArray[np.intp], x: NDArray[np.intp], unit: float) -> FloatArray:
    """Color and position of the chosen pixels, (n, 5)."""
    clean = np.clip(np.nan_to_num(pixels), 0, 1).astype(np.float32, copy=False)
    color = in_space(clean, "lab")[y, x]
    position = np.stack([y, x], axis=1).astype(np.float32) * np.float32(POSITION_WEIGHT / unit)
    return np.concatenate([color, position], axis=1)
