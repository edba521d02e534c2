"""Poisson problems on a rectangle with free edges, solved exactly by the cosine transform.

The discrete Laplacian with Neumann edges is diagonal under the type-II cosine transform, so
(screen - stiffness Laplace) u = f takes two transforms whatever its condition: no iterations and no tolerance.
"""

from __future__ import annotations

import numpy as np

from graphface.nodes.types import FloatArray

_LEAST = 1e-12


def solve(right: FloatArray, *, screen: float, stiffness: float = 1.0) -> FloatArray:
    """u with screen u - stiffness Laplace(u) = right, float32 H x W (or H x W x c, channel by channel).

    With `screen` 0 the constant is free; it is chosen such that u has mean 0.
    """
    from scipy.fft import dctn, idctn

    height, width = right.shape[:2]
    spectrum = dctn(right, axes=(0, 1), norm="ortho", workers=2)
    down, across = (2 - 2 * np.cos(np.pi * np.arange(n) / n) for n in (height, width))
    eigenvalues = screen + stiffness * (down[:, None] + across[None, :])
    if screen <= 0:
        eigenvalues[0, 0] = np.inf
    inverse = (1 / np.maximum(eigenvalues, _LEAST)).astype(np.float32)
    spectrum *= inverse.reshape(height, width, *[1] * (right.ndim - 2))
    return np.asarray(idctn(spectrum, axes=(0, 1), norm="ortho", workers=2), np.float32)


def gradient(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Forward differences down and across, of the shape of `values`; 0 in the last row or column."""
    down, across = np.zeros_like(values), np.zeros_like(values)
    np.subtract(values[1:], values[:-1], out=down[:-1])
    np.subtract(values[:, 1:], values[:, :-1], out=across[:, :-1])
    return down, across


def divergence(down: FloatArray, across: FloatArray) -> FloatArray:
    """Minus the adjoint of `gradient`; the last row of `down` and column of `across` take no part."""
    flow = np.zeros_like(down)
    flow[:-1] += down[:-1]
    flow[1:] -= down[:-1]
    flow[:, :-1] += across[:, :-1]
    flow[:, 1:] -= across[:, :-1]
    return flow
