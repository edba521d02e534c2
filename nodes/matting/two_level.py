"""A two-level preconditioner: a Gauss-Seidel sweep for high frequencies, a small direct solve for low ones.

Tang, Nabben, Vuik and Erlangga, Comparison of two-level preconditioners derived from deflation, domain decomposition
and multigrid methods, J. Sci. Comput. 2009; this is their A-DEF2. With Z a basis of functions nearly in the null space
of the matrix A, E = Z^T A Z and M a symmetric Gauss-Seidel sweep,

    y = M^-1 r,    z = y + Z E^-1 (Z^T r - (A Z)^T y)

Incomplete Cholesky factors cost ten times as much to compute, may not exist, and without the second level need four
times the steps. The sweep needs only a positive diagonal; PyMatting's compiled substitution runs it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import warn

Vector = NDArray[np.float64]


Solver = Callable[[Vector], Vector]


RIDGE = 1e-9
"""Added to the small system, relative to its diagonal: the colors of a block may be linearly dependent."""


class TwoLevel:
    """An approximate inverse of `system`, sparse (n, n), symmetric, with a positive diagonal and sorted rows.

    Args:
        coarse: Z, sparse (n, m); None: the sweep alone.
    """

    def __init__(self, system: Any, coarse: Any | None = None) -> None:
        self._sweep = _gauss_seidel(system)
        self._solve: Solver | None = None
        if coarse is not None and coarse.shape[1]:
            self._up, self._down = coarse, coarse.T.tocsr()
            self._image = system @ coarse
            self._image_down = self._image.T
            self._solve = _factored((self._down @ self._image).tocsc())

    def start(self, residual: Vector) -> tuple[Vector, Vector]:
        """The best correction in the coarse space, and A times it. A-DEF2 has to start from it."""
        if self._solve is None:
            return np.zeros_like(residual), np.zeros_like(residual)
        found = self._solve(self._down @ residual)
        return self._up @ found, self._image @ found

    def __call__(self, residual: Vector) -> Vector:
        swept = self._sweep(residual)
        if self._solve is not None:
            swept += self._up @ self._solve(self._down @ residual - self._image_down @ swept)
        return swept


def _gauss_seidel(system: Any) -> Solver:
    """The inverse of (D + U^T) D^-1 (D + U), D the diagonal of the system and U the part above it."""
    from pymatting.preconditioner.ichol import CholeskyDecomposition

    row = np.repeat(np.arange(system.shape[0], dtype=system.indices.dtype), np.diff(system.indptr))
    above = system.indices >= row
    lengths = np.add.reduceat(above, system.indptr[:-1], dtype=np.int64)
    starts = np.concatenate([[0], np.cumsum(lengths)])
    # Rows of the upper triangle are columns of the lower one: D + U^T, times D^-1/2. Each begins with its diagonal.
    root = np.sqrt(np.maximum(system.diagonal(), 1e-12))
    values = system.data[above]
    values /= np.repeat(root, lengths)
    values[starts[:-1]] = root
    return CholeskyDecomposition((values, system.indices[above].astype(np.int64), starts))  # type: ignore[no-any-return]


def _factored(small: Any) -> Solver | None:
    """The inverse of the small system, None (with a warning) where it has none."""
    from scipy.sparse import diags
    from scipy.sparse.linalg import splu

    diagonal = small.diagonal()
    floor = max(1e-12 * float(diagonal.max(initial=0.0)), 1e-30)
    regular = (small + diags(RIDGE * diagonal + floor)).tocsc()
    try:
        # The system is positive definite, so it needs no pivoting and can be ordered for small factors.
        factors = splu(regular, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    except (RuntimeError, MemoryError) as error:
        warn(f"matting: the coarse system cannot be factored ({error}); the solve goes on without it")
        return None
    return factors.solve  # type: ignore[no-any-return]
