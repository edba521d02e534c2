"""The shading of normals under a spherical-harmonic light."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.harmonics import basis, has_surface
from graphface.nodes.strips import by_strips
from graphface.nodes.types import Lighting, Normals, Shading


@node("sh.render")
def render(light: Lighting, normals: Normals, *, floor: Annotated[float, Field(ge=0, le=1)] = 0.0) -> Shading:
    """SH(n, l) = max(floor, sum_i l_i Y_i(n)), the shading of a surface under a light; 0 where there is no surface.

    Args:
        floor: least shading. A fitted light may be negative where the fit saw no surface, such as under the chin; no
            real light is.

    Returns:
        float32, H x W, or H x W x 3 for a colored light.
    """
    shading = np.zeros((*normals.shape[:2], *light.coefficients.shape[1:]), np.float32)

    def strip(rows: slice) -> None:
        covered = has_surface(normals[rows])
        values = basis(normals[rows][covered], light.order) @ light.coefficients
        shading[rows][covered] = np.maximum(values, np.float32(floor))

    by_strips(strip, normals.shape)
    return shading
