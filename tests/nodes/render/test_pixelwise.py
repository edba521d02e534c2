"""Relighting as a function of a pixel's color: the same as the operators that it stands for."""

from __future__ import annotations

from inspect import signature

import numpy as np
import pytest

from graphface.nodes.detail.split import split
from graphface.nodes.intrinsic.intensity import intensity
from graphface.nodes.matting.guided import guided
from graphface.nodes.render import pixelwise
from graphface.nodes.render.composite import composite
from graphface.nodes.render.pixelwise import Layers, Pixelwise
from graphface.nodes.render.relit import relit
from graphface.nodes.render.response import response
from graphface.nodes.types import Image, Landmarks, Scene, Segmentation

SIZE = (24, 32)


def landmarks() -> Landmarks:
    points = np.zeros((468, 3), np.float32)
    points[263, 0] = 20
    return Landmarks(points, "facemesh468")


def layers(rng, *, colored: bool, raised: float = 0.0, tint: float = 0.0, wall=False) -> tuple[Layers, np.ndarray]:
    """A picture of noise under new light, and what the operators make of it."""
    photo = Image(rng.random((*SIZE, 3), np.float32))
    unclipped = photo.with_pixels(photo.pixels + np.float32(raised) * (photo.pixels > 0.9))
    parts = intensity(unclipped)
    albedo = parts.albedo * np.float32([1 + tint, 1, 1 - tint])
    face = rng.random(SIZE, np.float32)
    labels = Segmentation(face, np.zeros_like(face), 1 - face)
    before = 0.3 + 0.4 * rng.random(SIZE, np.float32)
    after = rng.random((*SIZE, 3) if colored else SIZE, np.float32)
    detail = split(photo, albedo, before, unclipped=unclipped)
    reflected = response(parts.shading, before, labels)
    scene = Scene(background=0.5, ambient=1)
    behind = (0.3 + 0.4 * rng.random(after.shape, np.float32)) if wall else None
    shading = composite(before, after, scene, labels, response=reflected, wall=behind)
    highlights = (0.1 * rng.random((*SIZE, 3), np.float32)).astype(np.float32)
    result = relit(photo, scene, albedo, shading, detail, highlights)
    share = (1 - 0.5 * labels.background).astype(np.float32)
    made = Layers(
        pixels=photo.pixels,
        landmarks=landmarks(),
        albedo=albedo,
        detail=detail,
        before=before,
        after=after,
        wall=behind,
        background=labels.background,
        share=share,
        face=face,
        response=reflected,
        highlights=highlights,
        encoded=True,
    )
    return made, result.pixels


@pytest.mark.parametrize("wall", [False, True])
@pytest.mark.parametrize("colored", [False, True])
@pytest.mark.parametrize(("raised", "tint"), [(0.0, 0.0), (0.2, 0.0), (0.0, 0.2)])
def test_is_what_the_operators_make(rng, colored, raised, tint, wall):
    """At the working size the one-line form is the graph's own picture."""
    made, expected = layers(rng, colored=colored, raised=raised, tint=tint, wall=wall)
    rows = slice(3, 17)
    found = Pixelwise(made).at(SIZE).rows(rows, made.pixels[rows])
    np.testing.assert_allclose(found, expected[rows], atol=2e-4)


def test_the_same_light_is_the_photo(rng):
    """Of any size: what does not change is not touched."""
    made, _ = layers(rng, colored=False)
    still = Layers(**{**vars(made), "after": made.before, "highlights": None})
    large = rng.random((50, 70, 3), np.float32)
    found = Pixelwise(still).at((50, 70)).rows(slice(0, 50), large)
    np.testing.assert_allclose(found, large, atol=1e-6)


@pytest.mark.parametrize(
    ("operator", "names", "values"),
    [
        (intensity, ("floor",), (pixelwise._FLOOR,)),
        (split, ("floor", "bound"), (pixelwise._DETAIL_FLOOR, pixelwise._BOUND)),
        (response, ("floor", "rougher"), (pixelwise._RESPONSE_FLOOR, pixelwise._ROUGHER)),
        (relit, ("shoulder", "toe"), (pixelwise._SHOULDER, pixelwise._TOE)),
        (guided, ("radius", "ridge", "resolution"), (pixelwise._RADIUS, pixelwise._RIDGE, pixelwise._RESOLUTION)),
    ],
)
def test_settings_are_those_of_the_operators(operator, names, values):
    """A default that is changed in one place alone would make large photos another picture."""
    defaults = [signature(operator).parameters[name].default for name in names]
    np.testing.assert_allclose(values, defaults, rtol=1e-6)
