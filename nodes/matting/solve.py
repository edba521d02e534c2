"""Alphas from a sparse symmetric system: conjugate gradients that always come back with an answer."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import redirect_stdout
from io import StringIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphface import warn
from graphface.nodes.types import FloatArray

STEPS = 500
"""Most steps of conjugate gradients."""

DISCARD, FILL = 3e-3, 8
"""Entries of the factors below the first are dropped; they may have at most `FILL` times the entries of the matrix."""

SHIFTS = (1e-2, 0.1, 1.0, 10.0)
"""Added to the diagonal, each where the one before did not make it positive enough."""


def solve_alphas(
    matrix: Any,
    right: NDArray[np.float64],
    guess: FloatArray,
    *,
    trust: float,
    tolerance: float,
    start: FloatArray | None = None,
) -> FloatArray:
    """The x that solves (matrix + trust I) x = right + trust guess, float32 (n, columns of `right`).

    Args:
        matrix: sparse (n, n), symmetric, positive semi-definite. guess: (n, k), what rules where the matrix says
            nothing. start: (n, k), where the solve starts; the guess where there is none.
        tolerance: relative residual.

    Falls back, with a warning, on a diagonal preconditioner where the incomplete Cholesky factorization fails, on the
    best iterate where the solve does not converge, and on the start where it is not finite.
    """
    from scipy.sparse import identity
    from scipy.sparse.linalg import LinearOperator, cg

    trusted = np.clip(np.nan_to_num(guess.astype(np.float64)), 0, 1)
    begun = trusted if start is None else np.clip(np.nan_to_num(start.astype(np.float64)), 0, 1)
    system = (matrix + trust * identity(matrix.shape[0], format="csr")).tocsr()
    target = right + trust * trusted
    inverse = LinearOperator(system.shape, _preconditioner(system), dtype=np.float64)
    alphas = np.empty_like(begun)
    for k in range(begun.shape[1]):
        first = float(np.linalg.norm(target[:, k] - system @ begun[:, k]))
        least = max(tolerance * max(float(np.linalg.norm(target[:, k])), first), 1e-12)
        x, status = cg(system, target[:, k], x0=begun[:, k], rtol=0, atol=least, maxiter=STEPS, M=inverse)
        if status != 0:
            warn(f"matting: conjugate gradients did not reach {tolerance:g} in {STEPS} steps; taken as they are")
        if not np.isfinite(x).all():
            warn("matting: the solve is not finite; the labels' own softness is taken")
            x = begun[:, k]
        alphas[:, k] = x
    return alphas.astype(np.float32)


def _preconditioner(system: Any) -> Callable[[NDArray[np.float64]], NDArray[np.float64]]:
    """PyMatting's incomplete Cholesky factors, or one over the diagonal where they do not exist."""
    from pymatting.preconditioner.ichol import ichol
    from scipy.sparse import csc_matrix

    mirrored = csc_matrix(
        (system.data, system.indices, system.indptr), shape=system.shape
    )  # symmetric: rows are columns
    try:
        with redirect_stdout(StringIO()):  # every shift of the diagonal that it tries in vain is printed
            factors = ichol(mirrored, discard_threshold=DISCARD, max_nnz=FILL * max(system.nnz, 1), shifts=SHIFTS)
    except (ValueError, ArithmeticError) as error:
        warn(f"matting: incomplete Cholesky failed ({error}); the diagonal is the preconditioner, which takes longer")
        diagonal = np.maximum(system.diagonal(), 1e-12)
        return lambda residual: residual / diagonal
    return lambda residual: factors(residual)
