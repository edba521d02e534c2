"""Values whose parts do not belong together say so, before they reach code that believes them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphface.nodes.types import (
    Camera,
    Correspondence,
    DetailMap,
    Environment,
    Features,
    HeadMasks,
    Image,
    Intrinsic,
    Landmarks,
    Lighting,
    Mesh,
    Pins,
    RefinedSurface,
    Segmentation,
    Surface,
    Texture,
)
from graphface.nodes.types.agreement import mismatch, out_of_range


def flat(*shape):
    return np.zeros(shape, np.float32)


def whole(*numbers):
    return np.int32(numbers)


PLANE = flat(2, 3)
MESH = Mesh(flat(4, 3), whole([0, 1, 3]).reshape(1, 3), flat(4, 3), Camera(), 1.0, uv=flat(4, 2), mirror=whole(1, 0))
SURFACE = Surface(flat(2, 3, 3), PLANE, PLANE, np.full((2, 3), -1, np.int32), flat(2, 3, 3))
MATCH = Correspondence(flat(2, 3, 2), PLANE, PLANE, (4, 4), flat(2, 3, 2), PLANE)
FEATURES = Features(*[PLANE] * 8)
DETAIL = DetailMap(flat(2, 3, 3), gain=flat(2, 3, 3))

GOOD = [MESH, SURFACE, MATCH, FEATURES, DETAIL, Lighting(flat(4)), Lighting(flat(9, 3))]

BAD = [
    (replace(MESH, triangles=whole(0, 1, 4).reshape(1, 3)), "triangles has indices from 0 to 4, allowed are 0 to 3"),
    (replace(MESH, triangles=whole(0, 1, -1).reshape(1, 3)), "triangles has indices from -1"),
    (replace(MESH, vertices=flat(4, 3) + 1e30), "vertices reaches 1e.30, farther than"),
    (Landmarks(flat(9, 3) - 1e8, "mine"), "points reaches"),
    (replace(SURFACE, depth=PLANE + 1e9), "depth reaches"),
    (replace(MESH, normals=flat(3, 3)), r"normals has the shape \(3, 3\)"),
    (replace(MESH, uv=flat(4, 3)), "uv has the shape"),
    (replace(MESH, mirror=whole(9)), "mirror has indices"),
    (replace(MESH, mirror=whole(0, 0, 0, 0, 0)), "mirror is longer"),
    (replace(MESH, facemesh=whole(0)), "facemesh has the shape"),
    (replace(MESH, interocular=float("nan")), "interocular"),
    (replace(SURFACE, depth=flat(3, 3)), "depth has the shape"),
    (replace(SURFACE, triangle=np.full((2, 3), -2, np.int32)), "triangle has indices"),
    (RefinedSurface(SURFACE, flat(1, 1)), "shadow has the shape"),
    (replace(MATCH, mirrored=flat(3, 2, 2)), "mirrored has the shape"),
    (Pins(flat(2, 3)), "points has the shape"),
    (replace(FEATURES, nose=flat(3, 2)), "nose has the shape"),
    (HeadMasks(PLANE, PLANE, flat(1, 1)), "aggressive has the shape"),
    (Segmentation(PLANE, flat(3, 3), PLANE), "hair has the shape"),
    (replace(DETAIL, gain=flat(2, 2, 3)), "gain has the shape"),
    (Intrinsic(flat(2, 3, 3), flat(3, 2)), "shading has the shape"),
    (Texture(Image(flat(2, 3, 3)), PLANE), "image.pixels has the shape"),
    (Image(flat(2, 3)), "pixels has the shape"),
    (Image(flat(2, 3, 3), flat(3, 2)), "alpha has the shape"),
    (Image(flat(0, 3, 3)), "no pixels"),
    (Image(flat(2, 3, 3), encoding="cmyk"), "encoding is 'cmyk'"),
    (Environment(flat(2, 3)), "radiance has the shape"),
    (Environment(flat(2, 3, 3) - 1), "below 0"),
    (Lighting(flat(5)), "coefficients have the shape"),
    (Lighting(flat(4, 2)), "coefficients has the shape"),
    (Landmarks(flat(67, 3), "ibug68"), "points has the shape"),
    (Camera(scale=0.0), "scale above 0"),
    (Camera(nearness=float("inf")), "nearness of 0 or more"),
]


@pytest.mark.parametrize("value", GOOD, ids=lambda value: type(value).__name__)
def test_good(value):
    """Nothing is said of values that belong together."""
    assert value.flaw() is None


@pytest.mark.parametrize(("value", "said"), BAD, ids=[said for _, said in BAD])
def test_bad(value, said):
    """The part is named, with what was expected."""
    with pytest.raises(AssertionError, match=said):
        raise AssertionError(value.flaw())


def test_mismatch():
    """Letters are bound by the first part that has them, and named."""
    pins = Pins(flat(2, 4))
    assert mismatch(pins, {"points": "N 4"}) is None
    assert mismatch(pins, {"points": "N ..."}) is None
    assert mismatch(pins, {"points": "N N"}) is not None
    assert mismatch(MATCH, {"inside": "H W", "places": "W H 2"}).endswith(
        "with W = 3 as in 'inside', H = 2 as in 'inside'"
    )


def test_out_of_range():
    """Without indices none is wrong; -1 counts only where it means none."""
    assert out_of_range("i", None, 0) is None
    assert out_of_range("i", whole(), 0) is None
    assert out_of_range("i", whole(-1, 3), 4, none=True) is None
    assert out_of_range("i", whole(-1, 3), 4) is not None
