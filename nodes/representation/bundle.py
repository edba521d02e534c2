"""The parts of a representation put into one value."""

from __future__ import annotations

from graphface import node
from graphface.nodes.types import (
    Albedo,
    DetailMap,
    Image,
    Landmarks,
    Lighting,
    Mask,
    Mesh,
    Representation,
    Segmentation,
    Shading,
    Surface,
    Surroundings,
)


@node("representation.bundle")
def bundle(
    working: Image,
    landmarks: Landmarks,
    mesh: Mesh,
    surface: Surface,
    mask: Mask,
    labels: Segmentation,
    head: Mesh,
    head_surface: Surface,
    head_mask: Mask,
    surroundings: Surroundings,
    albedo: Albedo,
    shading: Shading,
    light: Lighting,
    estimated: Shading,
    spread: Shading,
    detail: DetailMap,
) -> Representation:
    """Put the parts of a representation into one value, which can be saved."""
    return Representation(
        working=working,
        landmarks=landmarks,
        mesh=mesh,
        surface=surface,
        mask=mask,
        labels=labels,
        head=head,
        head_surface=head_surface,
        head_mask=head_mask,
        surroundings=surroundings,
        albedo=albedo,
        shading=shading,
        light=light,
        estimated=estimated,
        spread=spread,
        detail=detail,
    )
