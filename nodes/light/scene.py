"""A scene from the light of a photograph: lighting transfer (paper, section 5.1)."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from graphface import node, warn
from graphface.nodes.color import decode_srgb
from graphface.nodes.harmonics import basis
from graphface.nodes.types import HarmonicLight, Image, Lighting, Scene

_DIRECTIONS = 600
"""Directions in which the light is decoded and fitted again."""


_LEAST_MEAN = 1e-3
"""Mean irradiance below which a reference is black."""


_RIDGE = 1e-6


@node("light.scene")
def scene(
    light: Lighting,
    reference: Image,
    *,
    background: Annotated[float, Field(ge=0, le=1)] = 0.35,
    hair: Annotated[float, Field(ge=0, le=1)] = 0.5,
    darkest: Annotated[float, Field(ge=0, le=1)] = 0.03,
) -> Scene:
    """The light fitted to a reference photo as a scene of mean irradiance 1: its directions, not its brightness.

    A light is fitted to shading in the photo's encoding, while a scene is linear. So the shading is decoded in the
    directions that a camera sees, and a second-order light is fitted to it there.

    Args:
        light: `sh.fit` of the reference.
        reference: its encoding is that of `light`.
        background, hair: see `Scene`.
        darkest: least irradiance relative to the mean, because the fit does not determine how dark a shadow is.
    """
    normals = _visible_directions()
    shading = np.maximum(basis(normals, light.order) @ light.coefficients.astype(np.float64), 0)
    linear = decode_srgb(shading.astype(np.float32)) if reference.encoding == "srgb" else shading
    mean = float(linear.mean())
    if mean < _LEAST_MEAN:
        warn("light.scene: the reference has hardly any light; even light is used instead")
        return Scene(ambient=1.0, background=background, hair=hair)
    target = np.maximum(np.asarray(linear, np.float64) / mean, darkest)
    design = basis(normals, 2)
    ridge = _RIDGE * len(normals) * np.eye(design.shape[1])
    coefficients = np.linalg.solve(design.T @ design + ridge, design.T @ target)
    values = tuple(tuple(map(float, row)) if coefficients.ndim == 2 else float(row) for row in coefficients)
    return Scene(lights=(HarmonicLight(coefficients=values),), background=background, hair=hair)


def _visible_directions() -> NDArray[np.float64]:
    """Unit vectors spread evenly over the half of the sphere that faces the viewer, (n, 3)."""
    index = np.arange(_DIRECTIONS) + 0.5
    z = 1 - index / _DIRECTIONS
    angle, radius = index * np.pi * (3 - np.sqrt(5.0)), np.sqrt(1 - z * z)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=1)
