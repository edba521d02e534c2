"""The face operators: one plug-in among others, found through the `graphface.nodes` entry-point group.

`pack` says which module declares which family, so that using one method imports one module.
"""

from graphface import Pack

_TYPES = "graphface.nodes.types"
_DETAIL = "graphface.nodes.detail"

pack = Pack(
    name="graphface",
    graphs="graphface.graphs",
    assets="graphface.nodes.landmarks.weights:ASSETS",
    operators={
        "image": "graphface.nodes.image",
        "landmarks": "graphface.nodes.landmarks.facemesh graphface.nodes.landmarks.given",
        "geometry": "graphface.nodes.morphable.facemesh graphface.nodes.morphable.morphable",
        "person": "graphface.nodes.morphable.morphable",
        "surface": "graphface.nodes.render.surface",
        "masks": "graphface.nodes.masks.face",
        "intrinsic": "graphface.nodes.intrinsic.intensity",
        "sh": "graphface.nodes.sh",
        "detail": " ".join(f"{_DETAIL}.{method}" for method in ("additive", "multiplicative", "none", "split")),
        "detail.edit": " ".join(f"{_DETAIL}.{edit}" for edit in ("bands", "wrinkles", "shine")),
        "render": "graphface.nodes.render.shade graphface.nodes.render.shadows graphface.nodes.render.spread",
        "blend": "graphface.nodes.blend",
    },
    types={
        **{
            name: f"{_TYPES}:{name}"
            for name in (
                "Albedo",
                "Camera",
                "Depth",
                "Detail",
                "DetailMap",
                "FitRecord",
                "Gain",
                "HeadMasks",
                "Image",
                "Intrinsic",
                "Landmarks",
                "Lighting",
                "LightingFit",
                "Mask",
                "Mesh",
                "Normals",
                "Segmentation",
                "Shading",
                "Surface",
            )
        },
        "MorphableModel": "graphface.nodes.morphable.model:MorphableModel",
        "Scene": "graphface.nodes.render.scene:Scene",
        "Shadows": "graphface.nodes.render.visibility:Shadows",
    },
)
