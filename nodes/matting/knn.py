"""Soft edges by the likest pixels, wherever they are: Chen, Li and Tang, KNN Matting, PAMI 2013.

A pixel's alpha is that of its K nearest neighbours in color and position: L = D - W with W the likeness of two pixels,
1 - |difference of features| / C. The graph has the band's pixels and those known ones that lie near it.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.color import in_space
from graphface.nodes.matting.band import band_of, likeliest_alphas, merged, soft_alphas
from graphface.nodes.matting.solve import solve_alphas
from graphface.nodes.types import FloatArray, Image, Landmarks, Segmentation

PLACE = 0.5
"""Weight of position beside color, per inter-ocular distance."""


@node("matting.knn")
def knn(
    photo: Image,
    labels: Segmentation,
    landmarks: Landmarks,
    *,
    width: Annotated[float, Field(gt=0, le=2)] = 0.06,
    strands: Annotated[float, Field(gt=0, le=2)] = 0.15,
    neighbors: Annotated[int, Field(ge=2, le=50)] = 10,
    rim: Annotated[float, Field(gt=0, le=1)] = 0.08,
    trust: Annotated[float, Field(ge=1e-9, le=1)] = 1e-2,
    tolerance: Annotated[float, Field(gt=0, le=0.1)] = 1e-3,
) -> Segmentation:
    """Alphas of face, hair and background, solved in the band where labels meet.

    Args:
        photo: the colors that alphas follow. labels: those outside of the band are kept as certain.
        width, strands: half the band's width in inter-ocular distances, in general and between hair and background.
        neighbors: K, of each pixel. rim: how far known pixels beside the band take part, in inter-ocular distances.
        trust: weight of the soft labels inside the band. tolerance: relative residual at which the solve stops.
    """
    import cv2
    from scipy.sparse import coo_matrix, diags, identity
    from scipy.spatial import cKDTree

    unit = max(landmarks.interocular, 1e-3)
    band = band_of(labels, unit, width=width, strands=strands)
    if band.empty:
        return labels
    near = cv2.distanceTransform((~band.unknown).astype(np.uint8), cv2.DIST_L2, 5) <= max(rim * unit, 2)
    y, x = np.nonzero(near)
    points = _features(photo.pixels[band.part], y, x, unit)
    wanted = band.unknown[near]
    count = len(points)
    found = cKDTree(points, compact_nodes=False, balanced_tree=False)
    index = found.query(points[wanted], k=min(neighbors + 1, count), eps=0.5)[1].reshape(int(wanted.sum()), -1)
    sources = np.repeat(np.flatnonzero(wanted), index.shape[1])
    targets = index.reshape(-1)
    apart = np.abs(points[sources] - points[targets]).sum(axis=1)
    likeness = np.maximum(1 - apart / points.shape[1], 1e-3) * (sources != targets)
    graph = coo_matrix((likeness, (sources, targets)), shape=(count, count)).tocsr()
    graph = graph + graph.T
    laplacian = (diags(np.asarray(graph.sum(axis=1)).reshape(-1)) - graph).tocsr()[wanted]
    fixed = likeliest_alphas(labels, band.part)[near].astype(np.float64)
    guess = soft_alphas(labels, band)
    right = trust * guess - laplacian[:, ~wanted] @ fixed[~wanted]
    system = (laplacian[:, wanted] + trust * identity(len(guess))).tocsr()
    return merged(labels, band, solve_alphas(system, right, guess, tolerance=tolerance))


def _features(pixels: FloatArray, y: NDArray[np.intp], x: NDArray[np.intp], unit: float) -> FloatArray:
    """Color and place of the chosen pixels, (n, 5)."""
    clean = np.clip(np.nan_to_num(pixels), 0, 1).astype(np.float32, copy=False)
    color = in_space(clean, "lab")[y, x]
    place = np.stack([y, x], axis=1).astype(np.float32) * np.float32(PLACE / unit)
    return np.concatenate([color, place], axis=1)
