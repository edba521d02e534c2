"""The matting Laplacian of the band alone: the rows of Levin's system for the unknown pixels.

    | A    B | | alpha |     A alpha = -B known,     A = L(band, band),  B = L(band, known)
    | B^T  C | | known |

Only rows of the band are built, strip by strip with PyMatting's compiled Laplacian. So memory depends on the band and
not on the photo, and the rows of A are computed in the order in which they are stored.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix


STRIP = 2**16
"""Approximate number of pixels in a strip, each with 25 entries of 16 bytes."""


NEIGHBORS = 25
"""Pixels that share a 3 x 3 window with a pixel: the entries in a row of the Laplacian."""


def band_system(
    colors: NDArray[np.float64],
    unknown: NDArray[np.bool_],
    known: FloatArray,
    guess: FloatArray,
    *,
    ridge: float,
    label_weight: float,
) -> tuple[csr_matrix, NDArray[np.float64]]:
    """A + w I, CSR (n, n) for the n unknown pixels in reading order, and -B known + w guess (n, 2), w the label weight.

    Args:
        colors: h x w x 3. unknown: h x w. known: h x w x 2, read only where pixels are known.
        guess: (n, 2), the soft labels. ridge: Levin's epsilon. label_weight: w.
    """
    from scipy.sparse import csr_matrix

    count = int(np.count_nonzero(unknown))
    number = np.full(unknown.shape, -1, np.int32)
    number[unknown] = np.arange(count, dtype=np.int32)
    right = label_weight * np.asarray(guess, np.float64)
    values, columns, lengths = [np.zeros(0)], [np.zeros(0, np.int32)], [np.zeros(1, np.int32)]
    height, width = unknown.shape
    rows = max(8, STRIP // max(width, 1))
    for top in range(0, height, rows):
        inner = slice(top, min(top + rows, height))
        across = np.flatnonzero(unknown[inner].any(axis=0))
        if not len(across):
            continue
        # Two pixels more on each side hold every window that a pixel of the strip lies in.
        strip = np.s_[max(0, top - 2) : inner.stop + 2, max(0, across[0] - 2) : across[-1] + 3]
        own = np.zeros(unknown[strip].shape, bool)
        own[top - strip[0].start :][: inner.stop - top] = unknown[inner, strip[1]]
        data, neighbor = _rows(colors[strip], own, ridge)
        data[:, NEIGHBORS // 2] += label_weight
        column = number[strip].reshape(-1)[neighbor]
        free = column >= 0
        values.append(data[free])
        columns.append(column[free])
        lengths.append(np.count_nonzero(free, axis=1))
        # The entries of B times the known alphas go to the right-hand side.
        border = np.flatnonzero(~free)
        row = border // NEIGHBORS
        product = data.reshape(-1)[border, None] * known[strip].reshape(-1, 2)[neighbor.reshape(-1)[border]]
        rows_here = number[strip][own]
        for k in range(2):
            right[rows_here, k] -= np.bincount(row, product[:, k], len(rows_here))
    starts = np.cumsum(np.concatenate(lengths), dtype=np.int32)
    system = csr_matrix((np.concatenate(values), np.concatenate(columns), starts), shape=(count, count))
    return system, right


def _rows(
    colors: NDArray[np.float64], wanted: NDArray[np.bool_], ridge: float
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The Laplacian's rows of the wanted pixels (m, 25), and the pixel of each entry's column."""
    from pymatting.laplacian.cf_laplacian import cf_laplacian

    within = np.flatnonzero(wanted)
    if min(wanted.shape) < 3:  # too small for a window: rows of 0
        return np.zeros((len(within), NEIGHBORS)), np.repeat(within[:, None], NEIGHBORS, axis=1)
    laplacian = cf_laplacian(np.ascontiguousarray(colors), ridge, 1, ~wanted)
    return laplacian.data.reshape(-1, NEIGHBORS)[within], laplacian.indices.reshape(-1, NEIGHBORS)[within]
