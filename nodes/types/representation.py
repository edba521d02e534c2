"""The whole representation of a face (paper, section 3) as one value."""

from __future__ import annotations

from dataclasses import dataclass

from graphface.nodes.types.agreement import mismatch, out_of_range
from graphface.nodes.types.appearance import DetailMap
from graphface.nodes.types.arrays import Albedo, Mask, Shading
from graphface.nodes.types.face_parts import Segmentation
from graphface.nodes.types.geometry import Landmarks, Mesh, Surface
from graphface.nodes.types.illumination import Lighting
from graphface.nodes.types.image import Image
from graphface.nodes.types.relighting import Surroundings


@dataclass(frozen=True)
class Representation:
    """All that `represent.yaml` computes from a photo; the fields are its outputs of the same names."""

    working: Image
    landmarks: Landmarks
    mesh: Mesh
    surface: Surface
    mask: Mask
    labels: Segmentation
    head: Mesh
    head_surface: Surface
    head_mask: Mask
    surroundings: Surroundings
    albedo: Albedo
    shading: Shading
    light: Lighting
    estimated: Shading
    spread: Shading
    detail: DetailMap

    def flaw(self) -> str | None:
        """Why its parts do not belong together."""
        maps = ("mask", "head_mask", "surface.coverage", "head_surface.coverage", "labels.face", "surroundings.weight")
        shadings = dict.fromkeys(("shading", "estimated", "spread"), "H W ...")
        shapes = {"working.pixels": "H W 3", "albedo": "H W 3", "detail.offset": "H W 3", **dict.fromkeys(maps, "H W")}
        return (
            mismatch(self, shapes | shadings)
            or out_of_range("surface.triangle", self.surface.triangle, len(self.mesh.triangles), none=True)
            or out_of_range("head_surface.triangle", self.head_surface.triangle, len(self.head.triangles), none=True)
        )
