"""The triangles, mirror pairs and mean shape of FaceMesh's 468 points.

`facemesh468.npz` beside this module was learned from 326 official headshots (see `graphface.nodes.learning.topology`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

_FILE = Path(__file__).with_name("facemesh468.npz")


EYE_CORNERS = (33, 263)
"""Outer corners of the right and the left eye."""


FOREHEAD, CHIN = 10, 152
"""Points on the midline, at the top and at the bottom."""


_AXIS_DEPTH = -1.16
"""z of the vertical axis of the cylinder that shapes are unrolled from, in inter-ocular distances from the mean point.
"""


@dataclass(frozen=True)
class Topology:
    """What all faces share.

    `triangles` int32 (T, 3), counter-clockwise seen from outside; `mirror` int32 (468,): the mirror image of each
    point; `mean` float32 (468, 3): the mean shape, camera axes, inter-ocular distance 1, origin at the mean point.
    """

    triangles: NDArray[np.int32]
    mirror: NDArray[np.int32]
    mean: NDArray[np.float32]


@cache
def facemesh_topology() -> Topology:
    """The topology of `landmarks.facemesh`, read once."""
    with np.load(_FILE, allow_pickle=False) as file:
        return Topology(file["triangles"], file["mirror"], file["mean"])


def cylinder(shape: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
    """Texture coordinates (V, 2) in [0, 1] of a shape (V, 3) in the frame of `Topology.mean`: `unrolled`, v up."""
    flat = unrolled(np.asarray(shape, np.float64))
    low, high = flat.min(axis=0), flat.max(axis=0)
    coordinates: NDArray[np.float64] = (flat - low) / np.maximum(high - low, 1e-9)
    return coordinates


def unrolled(shape: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angle about the vertical axis inside the head, and height: (V, 2)."""
    return np.stack([np.arctan2(shape[:, 0], shape[:, 2] - _AXIS_DEPTH), shape[:, 1]], axis=1)
