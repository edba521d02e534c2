"""A scene from the light of a photograph: relight one portrait like another (the paper's lighting transfer)."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from graphface import node, warn
from graphface.nodes.color import decode_srgb
from graphface.nodes.harmonics import basis
from graphface.nodes.types import HarmonicLight, Image, Lighting, Scene

_DIRECTIONS = 600


_LEAST_MEAN = 1e-3


@node("light.scene")
def scene_of(
    light: Lighting,
    reference: Image,
    *,
    background: Annotated[float, Field(ge=0, le=1)] = 0.35,
    hair: Annotated[float, Field(ge=0, le=1)] = 0.5,
    darkest: Annotated[float, Field(ge=0, le=1)] = 0.03,
) -> Scene:
    """The light fitted to one photo as a scene for another; brightness is the other's own, direction is this one's.

    A light is fitted to shading in the photo's encoding; a scene counts linear light. So the fitted shading is decoded
    on the directions that a camera can see, and a second-order light fitted to that.

    Args:
        light: `sh.fit` of the reference.
        reference: tells the encoding.
        background, hair: see `Scene`.
        darkest: least irradiance, relative to the mean: the fit says nothing about how black a shadow is.
    """
    normals = _seen_directions()
    shading = np.maximum(basis(normals, light.order) @ light.coefficients.astype(np.float64), 0)
    linear = decode_srgb(shading.astype(np.float32)) if reference.encoding == "srgb" else shading
    mean = float(linear.mean())
    if mean < _LEAST_MEAN:
        warn("light.scene: the reference has hardly any light; took even light instead")
        return Scene(ambient=1.0, background=background, hair=hair)
    target = np.maximum(np.asarray(linear, np.float64) / mean, darkest)
    design = basis(normals, 2)
    ridge = 1e-6 * len(normals) * np.eye(design.shape[1])
    coefficients = np.linalg.solve(design.T @ design + ridge, design.T @ target)
    values = tuple(tuple(map(float, row)) if coefficients.ndim == 2 else float(row) for row in coefficients)
    return Scene(lights=(HarmonicLight(coefficients=values),), background=background, hair=hair)


def _seen_directions() -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """Unit vectors spread evenly over the half of the sphere that faces the viewer, (n, 3)."""
    index = np.arange(_DIRECTIONS) + 0.5
    z = 1 - index / _DIRECTIONS
    turn, across = index * np.pi * (3 - np.sqrt(5.0)), np.sqrt(1 - z * z)
    return np.stack([across * np.cos(turn), across * np.sin(turn), z], axis=1)
