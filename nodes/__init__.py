"""The face operators: one plug-in among others, found through the `graphface.nodes` entry-point group.

`pack` says which module declares which family, so that using one method imports one module.
"""

from graphface import Pack

_TYPES = "graphface.nodes.types"
_INTRINSIC = ("intensity", "retinex", "multiscale_retinex", "bilateral", "log_tv", "l1_flatten", "bell2014")
_MASKS = "graphface.nodes.masks"
_LABELS = ("face", "geometric", "features", "cue", "hair", "classify", "network", "override")
_RENDER = ("samples", "shade", "shadows", "spread", "head", "skin", "specular", "composite", "relit")
_DETAIL = "graphface.nodes.detail"

pack = Pack(
    name="graphface",
    graphs="graphface.graphs",
    assets="graphface.nodes.landmarks.weights:ASSETS graphface.nodes.masks.weights:ASSETS",
    operators={
        "image": "graphface.nodes.image graphface.nodes.highlights",
        "landmarks": "graphface.nodes.landmarks.facemesh graphface.nodes.landmarks.given",
        "geometry": "graphface.nodes.morphable.facemesh graphface.nodes.morphable.morphable",
        "person": "graphface.nodes.morphable.morphable",
        "surface": "graphface.nodes.render.surface graphface.nodes.projection.coordinates",
        "texture": "graphface.nodes.projection.texture",
        "overlay": "graphface.nodes.projection.overlay",
        "export": "graphface.nodes.projection.export",
        "masks": " ".join(f"{_MASKS}.{m}" for m in _LABELS),
        "matting": " ".join(f"graphface.nodes.matting.{m}" for m in ("none", "guided", "closed_form", "knn")),
        "regions": "graphface.nodes.regions",
        "intrinsic": " ".join(f"graphface.nodes.intrinsic.{method}" for method in _INTRINSIC),
        "albedo": "graphface.nodes.intrinsic.shadow_colour",
        "metrics": "graphface.nodes.metrics.operators",
        "representation": "graphface.nodes.representation",
        "sh": " ".join(f"graphface.nodes.sh.{m}" for m in ("fitting", "rendering", "rotation", "environment", "ball")),
        "detail": " ".join(f"{_DETAIL}.{method}" for method in ("additive", "multiplicative", "none", "split")),
        "detail.edit": " ".join(f"{_DETAIL}.{edit}" for edit in ("bands", "wrinkles", "shine")),
        "render": " ".join(f"graphface.nodes.render.{stage}" for stage in _RENDER),
        "light": "graphface.nodes.render.light_of graphface.nodes.render.panorama",
        "scatter": "graphface.nodes.scatter.none graphface.nodes.scatter.gaussian graphface.nodes.scatter.screen_space",
        "transfer": "graphface.nodes.transfer",
        "warp": "graphface.nodes.warp.mesh graphface.nodes.warp.resample",
        "flow": " ".join(f"graphface.nodes.flow.{m}" for m in ("none", "dis", "farneback", "deepflow", "tvl1")),
        "makeup": " ".join(
            f"graphface.nodes.makeup.{stage}"
            for stage in (
                "features",
                "pigment",
                "tone",
                "detail",
                "in_front",
                "skin",
                "uncovered",
                "shaved",
                "coverage",
                "boundary",
            )
        ),
        "blend": "graphface.nodes.blend "
        + " ".join(f"graphface.nodes.blending.{method}" for method in ("linear", "multiband", "poisson")),
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
                "Direction",
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
        "FaceCoordinates": "graphface.nodes.projection.coordinates:FaceCoordinates",
        "Visibility": "graphface.nodes.projection.coordinates:Visibility",
        "Texture": "graphface.nodes.projection.texture:Texture",
        "TexturedMesh": "graphface.nodes.projection.export:TexturedMesh",
        "MorphableModel": "graphface.nodes.morphable.model:MorphableModel",
        "Correspondence": "graphface.nodes.warp.correspondence:Correspondence",
        "Features": "graphface.nodes.makeup.features:Features",
        "Judgements": "graphface.nodes.metrics.judgements:Judgements",
        "Pins": "graphface.nodes.warp.correspondence:Pins",
        "LabelWeights": "graphface.nodes.masks.label_weights:LabelWeights",
        "Environment": "graphface.nodes.envmap:Environment",
        "Regions": "graphface.nodes.regions:Regions",
        "Representation": "graphface.nodes.representation:Representation",
        "Samples": "graphface.nodes.render.samples:Samples",
        "Scene": "graphface.nodes.render.scene:Scene",
        "Shadows": "graphface.nodes.render.visibility:Shadows",
        "Surroundings": "graphface.nodes.render.spread:Surroundings",
    },
    schemas={"scene": "graphface.nodes.render.scene:Scene"},
)
