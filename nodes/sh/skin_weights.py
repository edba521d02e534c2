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
            family: 0 23.2, 0.2 23.4 dB. Frontally 27.4 and 27.6, under even light 31.1 and 32.1 dB; heads made from
            the same model as the fitted head 29.4 and 29.0 dB. What is left of the differences between mirrored points
            of 116 photographed faces, in the logarithm: 0.145 and 0.138, and with 1 0.141; `graphface bench light
            --symmetry`. Yale faces lit 50 degrees from the side, under eight lights: squared error 0.0147 and 0.0158.)
    """
    skin = np.minimum(labels.face, head)
    skin *= np.float32(beyond)
    return np.maximum(mask, skin, out=skin)
