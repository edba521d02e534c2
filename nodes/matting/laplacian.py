"""The matting Laplacian of the band alone: what Levin's system says of the pixels that are not known.

    | A    B | | alpha |     A alpha = -B known,     A = L(band, band),  B = L(band, known)
    | B^T  C | | known |

Nothing outside of the band is ever built. Windows are added up strip by strip with PyMatting's Laplacian, which is
compiled, so memory follows the band and not the photo, and the rows of A come out in the order they are stored in.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from graphface.nodes.types import FloatArray

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix


STRIP = 2**16
"""Pixels of a strip, about: 25 entries of 16 bytes for each are held at a time."""


NEIGHBORS = 25
"""Pixels that share a 3 x 3 window with a pixel: the entries in a row of the Laplacian."""


def band_system(
    colors: NDArray[np.float64],
    unknown: NDArray[np.bool_],
    known: FloatArray,
    guess: FloatArray,
    *,
    ridge: float,
    trust: float,
) -> tuple[csr_matrix, NDArray[np.float64]]:
    """The matrix A + trust I (n, n) of the n unknown pixels in reading order, and -B known + trust guess (n, 2).

    Args:
        colors: h x w x 3. unknown: h x w. known: h x w x 2, read where pixels are not unknown.
        guess: (n, 2), the soft labels. ridge: Levin's epsilon.
    """
    from scipy.sparse import csr_matrix

    count = int(np.count_nonzero(unknown))
    number = np.full(unknown.shape, -1, np.int32)
    number[unknown] = np.arange(count, dtype=np.int32)
    right = trust * np.asarray(guess, np.float64)
    values, columns, lengths = [np.zeros(0)], [np.zeros(0, np.int32)], [np.zeros(1, np.int32)]
    height, width = unknown.shape
    rows = max(8, STRIP // max(width, 1))
    for top in range(0, height, rows):
        inner = slice(top, min(top + rows, height))
        across = np.flatnonzero(unknown[inner].any(axis=0))
        if not len(across):
            continue
        # Every window that a pixel of the strip lies in: two pixels more on each side.
        strip = np.s_[max(0, top - 2) : inner.stop + 2, max(0, across[0] - 2) : across[-1] + 3]
        own = np.zeros(unknown[strip].shape, bool)
        own[top - strip[0].start :][: inner.stop - top] = unknown[inner, strip[1]]
        data, beside = _rows(colors[strip], own, ridge)
        data[:, NEIGHBORS // 2] += trust
        column = number[strip].reshape(-1)[beside]
        free = column >= 0
        values.append(data[free])
        columns.append(column[free])
        lengths.append(np.count_nonzero(free, axis=1))
        # The entries towards known pixels, times what is known there.
        border = np.flatnonzero(~free)
        row = border // NEIGHBORS
        towards = data.reshape(-1)[border, None] * known[strip].reshape(-1, 2)[beside.reshape(-1)[border]]
        mine = number[strip][own]
        for k in range(2):
            right[mine, k] -= np.bincount(row, towards[:, k], len(mine))
    starts = np.cumsum(np.concatenate(lengths), dtype=np.int32)
    system = csr_matrix((np.concatenate(values), np.concatenate(columns), starts), shape=(count, count))
    return system, right


def _rows(
    colors: NDArray[np.float64], wanted: NDArray[np.bool_], ridge: float
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The Laplacian's rows of the wanted pixels (m, 25), and the pixel that each entry is for."""
    from pymatting.laplacian.cf_laplacian import cf_laplacian

    within = np.flatnonzero(wanted)
    if min(wanted.shape) < 3:  # no window at all: each pixel for itself
        return np.zeros((len(within), NEIGHBORS)), np.repeat(within[:, None], NEIGHBORS, axis=1)
    laplacian = cf_laplacian(np.ascontiguousarray(colors), ridge, 1, ~wanted)
    return laplacian.data.reshape(-1, NEIGHBORS)[within], laplacian.indices.reshape(-1, NEIGHBORS)[within]
