"""The shading of skin, with or without subsurface scattering."""

from __future__ import annotations

from graphface import Lazy, Needs, UsageError, node
from graphface.nodes.types import Scene, Shading


def _needs(scene: Scene) -> Needs:
    if scene.scatter > 0:
        return {"shading": "the scene scatters light; the scattered shading is taken", "scattered": True}
    return {"shading": True, "scattered": "the scene scatters no light (scatter: 0)"}


@node("render.skin", needs=_needs)
def skin(scene: Scene, shading: Lazy[Shading] = None, scattered: Lazy[Shading] = None) -> Shading:
    """`scattered` if the scene scatters light beneath the skin, else `shading`.

    Raises:
        UsageError: the one that the scene needs is missing.
    """
    chosen = scattered if scene.scatter > 0 else shading
    if chosen is None:
        raise UsageError("render.skin needs the shading, and the scattered one where the scene has a scatter radius")
    return chosen
