"""The coarse space: functions that are linear in the color within every small block of pixels.

The matting Laplacian assumes that alpha is linear in the color of each small window, so these functions are nearly in
its null space, which conjugate gradients resolve slowly. There are few of them: the best solution among them is
computed directly (see `graphface.nodes.matting.two_level`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix


BLOCK = 6
"""Side of a block, pixels. Smaller blocks need fewer steps, and each step costs more."""


def color_lines(colors: NDArray[np.floating], unknown: NDArray[np.bool_], block: int = BLOCK) -> csr_matrix:
    """The functions 1, R, G and B of each block that has unknown pixels, (n, 4 * blocks): n unknown in reading order.

    Args:
        colors: h x w x 3. unknown: h x w.
    """
    from scipy.sparse import csr_matrix

    y, x = np.nonzero(unknown)
    place = (y // block) * (unknown.shape[1] // block + 1) + x // block
    taken = np.bincount(place) > 0
    member = (np.cumsum(taken, dtype=np.int32) - 1)[place]
    inside = colors[unknown]
    share = 1 / np.maximum(np.bincount(member), 1)
    functions = np.ones((len(y), 4))
    for c in range(3):
        # Colors minus the block's mean are orthogonal to the constant.
        functions[:, c + 1] = inside[:, c] - (share * np.bincount(member, inside[:, c]))[member]
    column = 4 * member[:, None] + np.arange(4, dtype=np.int32)
    starts = np.arange(0, 4 * len(y) + 1, 4, dtype=np.int32)
    return csr_matrix((functions.reshape(-1), column.reshape(-1), starts), shape=(len(y), 4 * int(taken.sum())))
