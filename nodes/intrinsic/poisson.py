"""Poisson problems on a rectangle with Neumann boundaries, solved exactly by the cosine transform.

The type-II cosine transform diagonalizes the discrete Laplacian with Neumann boundaries. So
(screen - stiffness Laplace) u = f takes two transforms, whatever its condition: no iterations and no tolerance.
"""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray

_LEAST_EIGENVALUE = 1e-12


def solve(right: FloatArray, *, screen: float, stiffness: float = 1.0) -> FloatArray:
    """u with screen u - stiffness Laplace(u) = right.

    Args:
        right: float32 H x W, or H x W x c, whose channels are solved one by one.
        screen: 0 or more. At 0 the solution is determined up to a constant; the one of mean 0 is returned.

    Returns:
        float32 of the shape of `right`.

    >>> ramp = np.arange(4, dtype=np.float32)[None, :]
    >>> solve(-divergence(*gradient(ramp)), screen=0).round(3)  # the ramp again, with mean 0
    array([[-1.5, -0.5,  0.5,  1.5]], dtype=float32)
    """
    from scipy.fft import dctn, idctn

    height, width = right.shape[:2]
    spectrum = dctn(right, axes=(0, 1), norm="ortho", workers=2)
    down, across = (2 - 2 * np.cos(np.pi * np.arange(n) / n) for n in (height, width))
    eigenvalues = screen + stiffness * (down[:, None] + across[None, :])
    if screen <= 0:
        eigenvalues[0, 0] = np.inf
    inverse = (1 / np.maximum(eigenvalues, _LEAST_EIGENVALUE)).astype(np.float32)
    spectrum *= inverse.reshape(height, width, *[1] * (right.ndim - 2))
    return np.asarray(idctn(spectrum, axes=(0, 1), norm="ortho", workers=2), np.float32)


def gradient(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Forward differences down and across, of the shape of `values`; 0 in the last row or column."""
    down, across = np.zeros_like(values), np.zeros_like(values)
    np.subtract(values[1:], values[:-1], out=down[:-1])
    np.subtract(values[:, 1:], values[:, :-1], out=across[:, :-1])
    return down, across


def divergence(down: FloatArray, across: FloatArray) -> FloatArray:
    """Minus the adjoint of `gradient`; the last row of `down` and the last column of `across` do not count."""
    result = np.zeros_like(down)
    result[:-1] += down[:-1]
    result[1:] -= down[:-1]
    result[:, :-1] += across[:, :-1]
    result[:, 1:] -= across[:, :-1]
    return result
