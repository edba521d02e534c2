"""Gaussian filtering in five or more dimensions at a cost linear in the number of points.

Adams, Baek, Davis, Fast High-Dimensional Filtering Using the Permutohedral Lattice, Eurographics 2010. Values are
splatted onto the corners of the lattice's simplices, blurred along each lattice direction, and sliced. Splatting and
slicing are a sparse matrix and its transpose, so repeated filtering (mean-field inference) builds the lattice once. A
regular grid would need the product of all extents; the lattice has corners only near points.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

_LEAST_WEIGHT = 1e-12


class Lattice:
    """The lattice of some points; `filter` is a Gaussian of standard deviation 1 in their feature space.

    Args:
        features: float (n, d), scaled such that the standard deviation is 1 in every dimension.
    """

    def __init__(self, features: NDArray[np.floating[Any]]) -> None:
        from scipy.sparse import csr_matrix

        n, d = features.shape
        keys, weights = _enclosing_simplices(_embedded(np.asarray(features, np.float64)))
        low = keys.reshape(-1, d).min(axis=0) - (d + 1)
        extent = keys.reshape(-1, d).max(axis=0) + (d + 2) - low
        radix = np.concatenate([[1], np.cumprod(extent[:-1])]).astype(np.int64)
        packed = (keys.reshape(-1, d) - low) @ radix
        corners, index = np.unique(packed, return_inverse=True)
        rows = np.repeat(np.arange(n), d + 1)
        self._slice = csr_matrix((weights.ravel().astype(np.float32), (rows, index.ravel())), shape=(n, len(corners)))
        self._splat = self._slice.T.tocsr()
        steps = [radix.sum() - (d + 1) * radix[axis] for axis in range(d)] + [radix.sum()]
        self._neighbours = [(_indices(corners, corners + s), _indices(corners, corners - s)) for s in steps]
        weight = self._filtered(np.ones((n, 1), np.float32))
        self._normalization = np.asarray(1 / np.maximum(weight, _LEAST_WEIGHT), np.float32)

    def filter(self, values: FloatArray) -> FloatArray:
        """Gaussian-weighted means of values (n, k) over all points, each point itself included: float32 (n, k)."""
        filtered: FloatArray = self._filtered(values) * self._normalization
        return filtered

    def _filtered(self, values: FloatArray) -> FloatArray:
        splatted = self._splat @ values
        padded = np.zeros((len(splatted) + 1, values.shape[1]), np.float32)  # the last row is a missing neighbour
        padded[:-1] = splatted
        for ahead, behind in self._neighbours:
            padded[:-1] = np.float32(0.5) * padded[:-1] + np.float32(0.25) * (padded[ahead] + padded[behind])
        return np.asarray(self._slice @ padded[:-1], np.float32)


def _embedded(features: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points (n, d) in the hyperplane of d + 1 coordinates that sum to 0, scaled to the blur's standard deviation."""
    n, d = features.shape
    index = np.arange(1, d + 1)
    scaled = features * (np.sqrt(2 / 3) * (d + 1) / np.sqrt(index * (index + 1)))
    embedded = np.zeros((n, d + 1))
    total = np.zeros(n)
    for axis in range(d, 0, -1):
        embedded[:, axis] = total - axis * scaled[:, axis - 1]
        total += scaled[:, axis - 1]
    embedded[:, 0] = total
    return embedded


def _enclosing_simplices(points: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """The simplex around each point of the hyperplane.

    Returns:
        The first d coordinates of its corners (n, d + 1, d), and the barycentric weights (n, d + 1).
    """
    n, d1 = points.shape
    d = d1 - 1
    base = np.rint(points / d1) * d1
    excess = np.rint(base.sum(axis=1) / d1).astype(np.int64)
    order = np.argsort(base - points, axis=1, kind="stable")
    rank = np.empty_like(order)
    np.put_along_axis(rank, order, np.broadcast_to(np.arange(d1), order.shape), axis=1)
    rank += excess[:, None]
    wrapped = np.where(rank < 0, 1, 0) - np.where(rank > d, 1, 0)
    rank += wrapped * d1
    base += wrapped * d1
    offset = (points - base) / d1
    weights = np.zeros((n, d1 + 1))
    rows = np.arange(n)
    for axis in range(d1):
        weights[rows, d - rank[:, axis]] += offset[:, axis]
        weights[rows, d1 - rank[:, axis]] -= offset[:, axis]
    weights[:, 0] += 1 + weights[:, d1]
    remainder = np.arange(d1)[None, :, None]
    corner = remainder - d1 * (rank[:, None, :d] > d - remainder)
    return base[:, None, :d].astype(np.int64) + corner, weights[:, :d1]


def _indices(corners: NDArray[np.int64], wanted: NDArray[np.int64]) -> NDArray[np.intp]:
    """Index of each wanted corner in the sorted corners; len(corners) where it is not among them."""
    index = np.searchsorted(corners, wanted)
    index[index == len(corners)] = 0
    return np.where(corners[index] == wanted, index, len(corners))
