"""Eyes, nose and mouth, whose detail makeup leaves alone."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.regions.atlas import atlas, projected
from graphface.nodes.types import Image, Landmarks, Mask

Softness = Annotated[float, Field(ge=0.01, le=0.5)]


@node("regions.features")
def features(photo: Image, landmarks: Landmarks, *, softness: Softness = 0.12) -> Mask:
    """Eyes (with brows), nose and mouth: where makeup keeps the input's own detail.

    Args, errors: as `regions.nine`.
    """
    drawn = atlas(softness)
    names = ("left_brow", "right_brow", "left_eye", "right_eye", "nose", "mouth")
    together = np.minimum(np.sum([drawn[name] for name in names], axis=0), 1).astype(np.float32)
    return projected([together], photo, landmarks)[0]
