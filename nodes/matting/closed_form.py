"""Soft edges by the matting Laplacian (paper, section 2).

Levin, Lischinski and Weiss, A Closed-Form Solution to Natural Image Matting, PAMI 2008.

Within every 3 x 3 window alpha is a linear function of the colour, up to a ridge; what that leaves over is alpha^T L
alpha. With the alphas outside of the band known,

    | A    B | | alpha |     A alpha = -B known,     A = L(band, band),  B = L(band, known)
    | B^T  C | | known |

and nothing outside of the band is ever built. Windows are added up tile by tile with PyMatting's Laplacian, which is
compiled, so memory follows the band and not the photo. One matrix serves face and hair; background is what is left,
since constants are in the Laplacian's null space: the three alphas sum to 1 by themselves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node
from graphface.nodes.matting.band import Band, band_of, likeliest_alphas, merged
from graphface.nodes.matting.solve import solve_alphas
from graphface.nodes.types import FloatArray, Image, Landmarks, Segmentation

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix

TILE = 96
"""Side of a tile, pixels."""

DIRECT = 20_000
"""Unknown pixels up to which the solve starts at the soft labels themselves."""

NEIGHBORS = 25
"""Pixels that share a 3 x 3 window with a pixel: the entries in a row of the Laplacian."""


@node("matting.closed_form")
def closed_form(
    photo: Image,
    labels: Segmentation,
    landmarks: Landmarks,
    *,
    width: Annotated[float, Field(gt=0, le=2)] = 0.06,
    strands: Annotated[float, Field(gt=0, le=2)] = 0.15,
    ridge: Annotated[float, Field(ge=1e-12, le=1)] = 1e-7,
    trust: Annotated[float, Field(ge=1e-9, le=1)] = 1e-4,
    tolerance: Annotated[float, Field(gt=0, le=0.1)] = 1e-3,
) -> Segmentation:
    """Alphas of face, hair and background, solved in the band where labels meet.

    The first call ever on a machine waits for PyMatting to compile itself, nearly a minute; the result is kept on disk.

    Args:
        photo: the colours that alphas follow. labels: those outside of the band are kept as certain.
        width, strands: half the band's width in inter-ocular distances, in general and between hair and background.
        ridge: Levin's epsilon, for windows of one colour.
        trust: weight of the soft labels inside the band: keeps the solve regular where nothing known is near, and alpha
            from running along hair into a face of its colour. The default stays within 0.005 of the alphas of Levin's
            own system on average over a portrait, and is nearer to the truth than less (hair on path-traced heads:
            overlap 0.967 at 1e-4, 0.966 at 1e-5).
        tolerance: relative residual at which the solve stops.
    """
    band = band_of(labels, max(landmarks.interocular, 1e-3), width=width, strands=strands)
    if band.empty:
        return labels
    colors = np.clip(np.nan_to_num(photo.pixels[band.part]), 0, 1).astype(np.float32)
    guess = np.stack([labels.face[band.part], labels.hair[band.part]], axis=2)
    known = likeliest_alphas(labels, band.part)
    return merged(labels, band, _solved(colors, band.unknown, known, guess, ridge, trust, tolerance))


def _solved(
    colors: FloatArray,
    unknown: NDArray[np.bool_],
    known: FloatArray,
    guess: FloatArray,
    ridge: float,
    trust: float,
    tolerance: float,
) -> FloatArray:
    """Alphas of the unknown pixels (n, 2), from a start that was solved for at half the size where there are many.

    What takes conjugate gradients long is what varies slowly over the band, and a residual hardly shows that it is
    still missing. The small picture has it right at a quarter of the cost.
    """
    import cv2

    start = None
    if np.count_nonzero(unknown) > DIRECT:
        height, width = unknown.shape
        size = ((width + 1) // 2, (height + 1) // 2)

        def half(values: FloatArray) -> FloatArray:
            return np.asarray(cv2.resize(values, size, interpolation=cv2.INTER_AREA), np.float32)

        small, coarse = half(unknown.astype(np.float32)) > 0, half(guess)
        coarse[small] = _solved(half(colors), small, half(known), coarse, ridge, trust, tolerance)
        start = np.asarray(cv2.resize(coarse, (width, height), interpolation=cv2.INTER_LINEAR), np.float32)[unknown]
    band = Band((slice(0, unknown.shape[0]), slice(0, unknown.shape[1])), unknown)
    matrix, right = band_system(colors.astype(np.float64), band, known, ridge)
    return solve_alphas(matrix, right, guess[unknown], trust=trust, tolerance=tolerance, start=start)


def band_system(
    colors: NDArray[np.float64], band: Band, known: FloatArray, ridge: float
) -> tuple[csr_matrix, NDArray[np.float64]]:
    """The matrix A (n, n) of the band's n pixels in reading order, and the right-hand sides -B known (n, 2)."""
    from pymatting.laplacian.cf_laplacian import cf_laplacian
    from scipy.sparse import coo_matrix

    count = int(band.unknown.sum())
    number = np.full(band.unknown.shape, -1, np.int32)
    number[band.unknown] = np.arange(count, dtype=np.int32)
    fixed = np.where(band.unknown[..., None], 0, known).astype(np.float64)
    right = np.zeros((count, 2))
    rows, columns, values = [], [], []
    height, width = band.unknown.shape
    for top in range(0, height, TILE):
        for left in range(0, width, TILE):
            # One more pixel on each side: every window is centred in exactly one tile.
            tile = np.s_[max(0, top - 1) : top + TILE + 1, max(0, left - 1) : left + TILE + 1]
            unknown = band.unknown[tile]
            if not unknown.any() or min(unknown.shape) < 3:
                continue
            laplacian = cf_laplacian(np.ascontiguousarray(colors[tile]), ridge, 1, ~unknown)
            within = np.flatnonzero(unknown)
            data = laplacian.data.reshape(-1, NEIGHBORS)[within]
            beside = laplacian.indices.reshape(-1, NEIGHBORS)[within]
            row = np.repeat(number[tile][unknown], NEIGHBORS).reshape(-1, NEIGHBORS)
            column = number[tile].reshape(-1)[beside]
            free = (column >= 0) & (data != 0)
            rows.append(row[free])
            columns.append(column[free])
            values.append(data[free])
            # The entries towards known pixels, times what is known there; unknown places hold 0.
            right[number[tile][unknown]] -= np.einsum("nj,njk->nk", data, fixed[tile].reshape(-1, 2)[beside])
    if not rows:
        return coo_matrix((count, count)).tocsr(), right
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return coo_matrix(entries, shape=(count, count)).tocsr(), right
