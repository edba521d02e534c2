"""The skin by which the photo's light is estimated."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node
from graphface.nodes.types import Mask, Segmentation


@node("sh.skin_weights")
def skin_weights(
    mask: Mask, head: Mask, labels: Segmentation, *, beyond: Annotated[float, Field(ge=0, le=1)] = 0.2
) -> Mask:
    """Weights of the pixels for `sh.fit`: 1 on the face, less on the skin of ears, neck and scalp.

    Most normals of a face point to the camera, and lids, lips and stubble are darker than the rest: a light that is
    fitted to the face alone takes them for shading, and comes out too directional. Ears and neck show other normals
    and even skin. They are more often in shadow, so they count less.

    Args:
        mask: the face by its geometry. head: the fitted head by its geometry. labels: where skin is.
        beyond: weight of the head's other skin. (From photos under four side lights, two path-traced heads of another
            family: 0 23.0, 0.2 23.2 dB. Frontally 27.3 and 27.5, under even light 31.0 and 31.9 dB; heads made from
            the same model as the fitted head 29.1 and 28.7 dB. What is left of the differences between mirrored points
            of 116 photographed faces, in the logarithm: 0.149 and 0.142, and with 1 0.144; `graphface bench light
            --symmetry`. Yale faces lit from the side, relit frontally: squared error 0.0131 and 0.0136.)
    """
    skin = np.minimum(labels.face, head)
    skin *= np.float32(beyond)
    return np.maximum(mask, skin, out=skin)
